#include "evolution/findings/pressure_key.h"

#include <algorithm>
#include <cmath>

#include "io/text/formatted.h"

namespace menger::evolution {

double rounded_to_rest_Pa(double pressure_Pa) {
  constexpr double digits = 3.0;
  const double step_Pa =
      std::pow(10.0, std::max(0.0, std::floor(std::log10(std::max(std::abs(pressure_Pa), 1.0))) - digits + 1.0));
  const double rounding = 1e-9;
  const double steps = std::floor(std::abs(pressure_Pa) / step_Pa + rounding);
  return std::copysign(steps * step_Pa, pressure_Pa);
}

std::string pressure_of_key(double pressure_Pa) { return io::formatted("%.0f Pa", rounded_to_rest_Pa(pressure_Pa)); }

}  // namespace menger::evolution
