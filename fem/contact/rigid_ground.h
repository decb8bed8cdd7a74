#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "io/device/host_device.h"

namespace menger::fem {

/// A coefficient of friction that depends on the direction of sliding.
struct DirectionalFriction {
  std::array<double, 2> forward{1.0,
                                0.0};  ///< unit vector in the plane of the ground; along it the coefficients stay as they are
  double backward_factor = 1.0;        ///< factor of the coefficients for sliding against `forward`, >= 0
  double sideways_factor = 1.0;        ///< factor of the coefficients for sliding across `forward`, >= 0
};

/// Coulomb's friction. At rest it holds up to the static coefficient times the normal force. During sliding it is the kinetic
/// coefficient times the normal force, against the velocity.
struct Friction {
  double static_coefficient = 0.0;   ///< >= kinetic
  double kinetic_coefficient = 0.0;  ///< >= 0
  /// The speed up to which friction grows in proportion to the speed, with the static coefficient, so that loaded points creep.
  /// Above it the kinetic coefficient acts. 0: points at rest stay exactly at rest.
  /// Example: a bar of two modules of 20 mm travels 0.261 mm in three periods (out of phase, 5 kPa, 3 Hz, coefficients 0.6 and
  /// 0.5). Speeds of 1e-4, 1e-3 and 1e-2 m/s reduce this by 5, 18 and 33 %. Half the step changes it by 0.2 % at 0 and by less
  /// than 0.1 % at these speeds.
  double regularisation_speed_m_per_s = 0.0;
  std::optional<DirectionalFriction> directional{};
};

/// A rigid plane z = height. Nodes below it are pushed up in proportion to their depth.
struct RigidGround {
  double height_m = 0.0;
  /// Pressure divided by depth, > 0. A node of outer area A has a spring of stiffness A times this. Under a pressure q the depth
  /// is q divided by it, away from edges.
  double stiffness_Pa_per_m = 0.0;
  Friction friction;
};

/// The default stiffness of a ground: `fraction` of M / h, the stiffness of a layer of elements against a change of its
/// thickness. With 0.05 and the bulk modulus, steps become 2 % shorter on walls of one element of 2 mm, and the mean depth under
/// the weight of a robot of 18 cells of 1 cm with such walls is 1.4e-3 h. Nodes on the edges and corners of the contact area also
/// carry springs for their side faces, so they lie less deep under the same pressure.
/// @param modulus_Pa M: the largest bulk modulus of a body; less for thin-wall elements, see contact_modulus_Pa
/// @param edge_m h, the shortest edge of its elements
constexpr double ground_stiffness_Pa_per_m(double modulus_Pa, double edge_m, double fraction = 0.05) {
  return fraction * modulus_Pa / edge_m;
}

/// The factor of both coefficients of friction for sliding along a direction d: f c^2 + sideways (1 - c^2), with c = d . forward
/// and f = 1 (c > 0) or backward. @param velocity of any length; a zero velocity gives 1
MENGER_HOST_DEVICE inline double directional_factor(const Friction& friction, const std::array<double, 2>& velocity) {
  const double speed = std::hypot(velocity[0], velocity[1]);
  if (!friction.directional || speed == 0.0) return 1.0;
  const DirectionalFriction& directional = *friction.directional;
  const double cosine = (velocity[0] * directional.forward[0] + velocity[1] * directional.forward[1]) / speed;
  const double along = cosine > 0.0 ? 1.0 : directional.backward_factor;
  return along * cosine * cosine + directional.sideways_factor * (1.0 - cosine * cosine);
}

/// The velocity of a node in the plane after friction, at the end of a step. It is the implicit solution for one node. It is
/// stable for any step, and friction never does more than stop the node.
/// @param before velocity at the start of the step, m/s; exactly zero: static friction
/// @param trial velocity that the node would reach without friction, m/s
/// @param normal_change step times normal force over mass, m/s, >= 0
MENGER_HOST_DEVICE inline std::array<double, 2> velocity_after_friction(const Friction& friction,
                                                                        const std::array<double, 2>& before,
                                                                        const std::array<double, 2>& trial,
                                                                        double normal_change) {
  const double speed = std::hypot(trial[0], trial[1]);
  if (speed == 0.0) return trial;
  const double scale = directional_factor(friction, trial) * normal_change;
  const double static_change = friction.static_coefficient * scale;
  const double kinetic_change = friction.kinetic_coefficient * scale;
  double slower = std::fmax(speed - kinetic_change, 0.0);
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
