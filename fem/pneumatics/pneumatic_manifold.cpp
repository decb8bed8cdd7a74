#include "fem/pneumatics/pneumatic_manifold.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fem/pneumatics/pneumatic_line.h"

namespace menger::fem {
namespace {

constexpr int most_iterations = 60;
constexpr double tolerance = 1e-13;  // of the absolute pressure; rounding leaves about 1e-15

/// Free air at a pressure and how it changes with it.
struct Air {
  double free_air_m3;
  double derivative_m3_per_Pa;
};

Air air_at(const PneumaticGas& gas, double pressure_Pa, double volume_m3, double volume_derivative) {
  const double per_volume = free_air_m3(gas, pressure_Pa, 1.0);
  const double air = volume_m3 * per_volume;
  return {air, volume_derivative * per_volume + air / (gas.exponent * (pressure_Pa + gas.ambient_pressure_Pa))};
}

Air air_of(const PneumaticGas& gas, const LineEnd& end) {
  const double derivative = end.plenum != nullptr ? end.plenum->derivative_m3_per_Pa(end.pressure_Pa) : 0.0;
  return air_at(gas, end.pressure_Pa, end.volume_at_m3(end.pressure_Pa), derivative);
}

/// One end's equation, linear about its pressure: change = by_root * (change of the root) + offset.
struct EndChange {
  double by_root;
  double offset_Pa;
};

EndChange change_of(const PneumaticGas& gas, double time_s, double root_Pa, const LineEnd& end, const Air& air) {
  const double ambient = gas.ambient_pressure_Pa;
  const ResistedFlow flow = resisted_flow(line_drive_Pa(gas, root_Pa, end.pressure_Pa), end.laminar_drive_Pa);
  const double residual = end.resistance_Pa_s_per_m3 * (air.free_air_m3 - end.free_air_m3) - time_s * flow.flow_Pa;
  const double slope =
      end.resistance_Pa_s_per_m3 * air.derivative_m3_per_Pa + time_s * flow.by_drive * (end.pressure_Pa + ambient) / ambient;
  return {time_s * flow.by_drive * (root_Pa + ambient) / ambient / slope, -residual / slope};
}

/// Adds a change, which must not lead to vacuum or far away. @return the change in parts of the absolute pressure
double add_change(const PneumaticGas& gas, double change_Pa, double& pressure_Pa) {
  const double absolute = pressure_Pa + gas.ambient_pressure_Pa;
  pressure_Pa += std::clamp(change_Pa, -0.8 * absolute, 4.0 * absolute);
  return std::abs(change_Pa) / absolute;
}

}  // namespace

double LineEnd::volume_at_m3(double at_Pa) const { return volume_m3 + (plenum != nullptr ? plenum->volume_m3(at_Pa) : 0.0); }

bool relax(const PneumaticGas& gas, double time_s, Manifold& manifold) {
  const bool is_source = manifold.source_pressure_Pa.has_value();
  if (is_source) manifold.pressure_Pa = *manifold.source_pressure_Pa;
  std::vector<EndChange> changes(manifold.ends.size());
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    double excess = 0.0;  // of air, beyond what there is
    double slope = 0.0;
    if (!is_source) {
      const Air root = air_at(gas, manifold.pressure_Pa, manifold.volume_m3, 0.0);
      excess = root.free_air_m3 - manifold.free_air_m3;
      slope = root.derivative_m3_per_Pa;
    }
    for (std::size_t j = 0; j < changes.size(); ++j) {
      const LineEnd& end = manifold.ends[j];
      const Air air = air_of(gas, end);
      changes[j] = change_of(gas, time_s, manifold.pressure_Pa, end, air);
      excess += air.free_air_m3 - end.free_air_m3 + air.derivative_m3_per_Pa * changes[j].offset_Pa;
      slope += air.derivative_m3_per_Pa * changes[j].by_root;
    }
    const double root_change = is_source ? 0.0 : -excess / slope;
    // No maximum: it would lose what is not a number.
    bool has_converged = add_change(gas, root_change, manifold.pressure_Pa) <= tolerance;
    for (std::size_t j = 0; j < changes.size(); ++j) {
      const double change_Pa = changes[j].by_root * root_change + changes[j].offset_Pa;
      if (!(add_change(gas, change_Pa, manifold.ends[j].pressure_Pa) <= tolerance)) has_converged = false;
    }
    if (has_converged) return true;
  }
  return false;
}

}  // namespace menger::fem
