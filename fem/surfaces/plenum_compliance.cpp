#include "fem/surfaces/plenum_compliance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace menger::fem {
namespace {

/// The index of the first point above a pressure: 0 below all points, the number of points from the last one on.
std::size_t after(const PlenumCompliance& plenum, double pressure_Pa) {
  const auto& pressures = plenum.pressures_Pa;
  return static_cast<std::size_t>(std::upper_bound(pressures.begin(), pressures.end(), pressure_Pa) - pressures.begin());
}

}  // namespace

double PlenumCompliance::volume_m3(double pressure_Pa) const {
  const std::size_t n = after(*this, pressure_Pa);
  if (n == 0) return volumes_m3.front();
  if (n == volumes_m3.size()) return volumes_m3.back();
  const double part = (pressure_Pa - pressures_Pa[n - 1]) / (pressures_Pa[n] - pressures_Pa[n - 1]);
  return std::lerp(volumes_m3[n - 1], volumes_m3[n], part);
}

double PlenumCompliance::derivative_m3_per_Pa(double pressure_Pa) const {
  const std::size_t n = after(*this, pressure_Pa);
  if (n == 0 || n == volumes_m3.size()) return 0.0;
  return (volumes_m3[n] - volumes_m3[n - 1]) / (pressures_Pa[n] - pressures_Pa[n - 1]);
}

double PlenumCompliance::work_J(double from_Pa, double to_Pa) const {
  const double low = std::min(from_Pa, to_Pa);
  const double high = std::max(from_Pa, to_Pa);
  double work = 0.0;
  for (std::size_t n = std::max<std::size_t>(1, after(*this, low)); n < pressures_Pa.size() && pressures_Pa[n - 1] < high; ++n) {
    const double begin = std::max(low, pressures_Pa[n - 1]);
    const double end = std::min(high, pressures_Pa[n]);
    work += 0.5 * (begin + end) * (volumes_m3[n] - volumes_m3[n - 1]) / (pressures_Pa[n] - pressures_Pa[n - 1]) * (end - begin);
  }
  return from_Pa <= to_Pa ? work : -work;
}

bool PlenumCompliance::contains(double pressure_Pa) const {
  return pressure_Pa >= pressures_Pa.front() && pressure_Pa <= pressures_Pa.back();
}

}  // namespace menger::fem
