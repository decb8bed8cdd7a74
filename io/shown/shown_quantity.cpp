#include "io/shown/shown_quantity.h"

#include <algorithm>
#include <cmath>

#include "io/text/formatted.h"

namespace menger::io {
namespace {

/// Nobody means less: what rounding leaves of nothing is told as nothing.
constexpr double least_length_m = 1e-8;
constexpr double least_body_lengths = 1e-4;

}  // namespace

std::string kilopascals(double pressure_Pa, int digits) { return shown(1e-3 * pressure_Pa, digits) + " kPa"; }

double rounded_towards_rest(double pressure_Pa) {
  constexpr double digits = 3.0;
  const double step_Pa =
      std::pow(10.0, std::max(0.0, std::floor(std::log10(std::max(std::abs(pressure_Pa), 1.0))) - digits + 1.0));
  const double rounding = 1e-9;
  const double steps = std::floor(std::abs(pressure_Pa) / step_Pa + rounding);
  return std::copysign(steps * step_Pa, pressure_Pa);
}

std::string pascals_towards_rest(double pressure_Pa) { return formatted("%.0f Pa", rounded_towards_rest(pressure_Pa)); }

std::string millimetres(double length_m, int digits) {
  return shown(std::abs(length_m) < least_length_m ? 0.0 : 1e3 * length_m, digits) + " mm";
}

std::string percents(double fraction) {
  const double percent = 100.0 * fraction;
  return formatted(std::abs(percent) < 9.95 ? "%.2g %%" : "%.0f %%", percent);
}

std::string degrees(double angle_deg) {
  const std::string text = formatted("%.0f", std::round(angle_deg) + 0.0);
  return text + (text == "1" || text == "-1" ? " degree" : " degrees");
}

std::string body_lengths(double number) {
  const std::string text = shown(std::abs(number) < least_body_lengths ? 0.0 : number, 2);
  return text + (text == "1" ? " body length" : " body lengths");
}

}  // namespace menger::io
