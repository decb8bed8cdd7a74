#include "fem/contact/rigid_ground.h"

#include <algorithm>
#include <cmath>

namespace menger::fem {

double directional_factor(const Friction& friction, const std::array<double, 2>& velocity) {
  const double speed = std::hypot(velocity[0], velocity[1]);
  if (!friction.directional || speed == 0.0) return 1.0;
  const DirectionalFriction& directional = *friction.directional;
  const double cosine = (velocity[0] * directional.forward[0] + velocity[1] * directional.forward[1]) / speed;
  const double along = cosine > 0.0 ? 1.0 : directional.backward_factor;
  return along * cosine * cosine + directional.sideways_factor * (1.0 - cosine * cosine);
}

std::array<double, 2> velocity_after_friction(const Friction& friction, const std::array<double, 2>& before,
                                              const std::array<double, 2>& trial, double normal_change) {
  const double speed = std::hypot(trial[0], trial[1]);
  if (speed == 0.0) return trial;
  const double scale = directional_factor(friction, trial) * normal_change;
  const double static_change = friction.static_coefficient * scale;
  const double kinetic_change = friction.kinetic_coefficient * scale;
  double slower = std::max(speed - kinetic_change, 0.0);
  const double limit = friction.regularisation_speed_m_per_s;
  if (limit > 0.0) {
    // Friction that falls with the speed has two solutions, so both branches may be possible for a node that slid. It stays on
    // its own.
    const bool slides_on = std::hypot(before[0], before[1]) > limit && slower > limit;
    const double creeping = speed / (1.0 + static_change / limit);
    if (!slides_on && creeping <= limit) slower = creeping;
  } else if (before[0] == 0.0 && before[1] == 0.0 && speed <= static_change) {
    slower = 0.0;
  }
  return {trial[0] * slower / speed, trial[1] * slower / speed};
}

}  // namespace menger::fem
