#include "fem/pneumatics/pneumatic_line.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace menger::fem {

using std::numbers::pi;

PneumaticLine round_line(double length_m, const RoundBore& bore) {
  assert(length_m > 0.0 && bore.diameter_m > 0.0 && bore.viscosity_Pa_s > 0.0);
  const double square = bore.diameter_m * bore.diameter_m;
  return {.resistance_Pa_s_per_m3 = 128.0 * bore.viscosity_Pa_s * length_m / (pi * square * square),
          .volume_m3 = 0.25 * pi * square * length_m,
          .bore = bore};
}

PneumaticLine round_line_of(double length_m, double resistance_Pa_s_per_m3) {
  assert(length_m > 0.0 && resistance_Pa_s_per_m3 > 0.0);
  return round_line(length_m, {std::pow(128.0 * air_viscosity_Pa_s * length_m / (pi * resistance_Pa_s_per_m3), 0.25)});
}

double line_drive_Pa(const PneumaticGas& gas, double from_Pa, double to_Pa) {
  return (from_Pa - to_Pa) * (1.0 + 0.5 * (from_Pa + to_Pa) / gas.ambient_pressure_Pa);
}

double laminar_drive_Pa(const PneumaticGas& gas, const PneumaticLine& line) {
  if (!line.bore) return std::numeric_limits<double>::infinity();
  const double crossing = std::pow(64.0 / 0.3164, 4.0 / 3.0);  // where 64 / Re meets 0.3164 Re^(-1/4)
  return line.resistance_Pa_s_per_m3 * crossing / reynolds_number(gas, 1.0, *line.bore);
}

ResistedFlow resisted_flow(double drive_Pa, double laminar_drive_Pa) {
  const double ratio = std::abs(drive_Pa) / laminar_drive_Pa;
  if (!(ratio > 1.0)) return {drive_Pa, 1.0};
  const double share = std::pow(ratio, -3.0 / 7.0);
  return {drive_Pa * share, 4.0 / 7.0 * share};
}

double line_flow_m3_per_s(const PneumaticGas& gas, const PneumaticLine& line, double from_Pa, double to_Pa) {
  assert(line.resistance_Pa_s_per_m3 > 0.0);
  return resisted_flow(line_drive_Pa(gas, from_Pa, to_Pa), laminar_drive_Pa(gas, line)).flow_Pa / line.resistance_Pa_s_per_m3;
}

double reynolds_number(const PneumaticGas& gas, double flow_m3_per_s, const RoundBore& bore) {
  const double density_kg_per_m3 = air_density_kg_per_m3 * gas.ambient_pressure_Pa / standard_atmosphere_Pa;
  return 4.0 * density_kg_per_m3 * std::abs(flow_m3_per_s) / (pi * bore.diameter_m * bore.viscosity_Pa_s);
}

}  // namespace menger::fem
