#pragma once

// What a step does to the velocity of one node, for processors and for graphics processors.

#include <array>
#include <cstddef>

#include "fem/contact/rigid_ground.h"
#include "io/device/host_device.h"

namespace menger::fem {

/// The coefficients of a kick: v1 = kept v0 + time_s f / m, where time_s is dt / (1 + a dt/2).
struct Kick {
  double kept;
  double share;  ///< 1 / (1 + a dt/2)
  double time_s;
};

/// Returns the kick of a duration dt. Mass damping acts on the mean of both velocities: (1 + a dt/2) v1 = (1 - a dt/2) v0 + dt
/// f/m.
MENGER_HOST_DEVICE inline Kick kick_of(double time_s, double mass_damping_per_s) {
  const double damping = 0.5 * time_s * mass_damping_per_s;
  const double share = 1.0 / (1.0 + damping);
  return {(1.0 - damping) * share, share, time_s * share};
}

/// Applies friction to the velocity that all other forces would give.
/// @param after that velocity, changed
/// @return the energy lost, J
MENGER_HOST_DEVICE inline double apply_friction(const Friction& friction, const Kick& kick, double normal_N, double mass,
                                                const double* before, double* after) {
  const double change = kick.time_s * normal_N / mass;
  const auto slid = velocity_after_friction(friction, {before[0], before[1]}, {after[0], after[1]}, change);
  double lost = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const double impulse = mass * (slid[i] - after[i]) / kick.share;
    lost -= impulse * 0.5 * (before[i] + slid[i]);
    after[i] = slid[i];
  }
  return lost;
}

}  // namespace menger::fem
