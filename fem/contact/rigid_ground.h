#pragma once

#include <array>
#include <optional>

namespace menger::fem {

/// A coefficient of friction that depends on the direction of sliding.
struct DirectionalFriction {
  std::array<double, 2> forward{1.0, 0.0};  ///< unit vector in the plane of the ground; coefficients there stay as they are
  double backward_factor = 1.0;             ///< of coefficients against that direction, >= 0
  double sideways_factor = 1.0;             ///< and across it, >= 0
};

/// Coulomb's friction: at rest up to the static coefficient times the normal force, while sliding the kinetic one, against the
/// velocity.
struct Friction {
  double static_coefficient = 0.0;   ///< >= kinetic
  double kinetic_coefficient = 0.0;  ///< >= 0
  /// 0: points at rest stay at rest exactly. Otherwise friction grows in proportion to the speed up to this one (with the static
  /// coefficient), so that loaded points creep; beyond it they feel the kinetic coefficient. Of what a bar of two modules of 20
  /// mm travels in three periods (0.261 mm; out of phase, 5 kPa, 3 Hz, 0.6 and 0.5) 1e-4, 1e-3 and 1e-2 m/s take 5, 18 and 33 %;
  /// half the step changes it by 0.2 % at 0 and by less than 0.1 % there.
  double regularisation_speed_m_per_s = 0.0;
  std::optional<DirectionalFriction> directional{};
};

/// A rigid plane z = height below which nodes are pushed up in proportion to their depth.
struct RigidGround {
  double height_m = 0.0;
  /// Pressure by depth, > 0; a node of outer area A has the spring A times this. Depth under a pressure q is q over it, away
  /// from edges.
  double stiffness_Pa_per_m = 0.0;
  Friction friction;
};

/// The default rule for a ground's stiffness: `fraction` of that of a layer of elements against a change of its thickness, kappa
/// / h. At 0.05 steps get two parts in a hundred shorter on walls of one element of 2 mm, and the mean depth under the weight of
/// a robot of 18 cells of 1 cm with such walls is 1.4e-3 h. Nodes on the edges and corners of what touches the ground have
/// springs of their side faces, too, and lie less deep under the same pressure.
/// @param bulk_modulus_Pa largest of the body @param edge_m shortest edge of its elements
constexpr double ground_stiffness_Pa_per_m(double bulk_modulus_Pa, double edge_m, double fraction = 0.05) {
  return fraction * bulk_modulus_Pa / edge_m;
}

/// The factor of both coefficients for sliding along a direction d: f c^2 + sideways (1 - c^2) with c = d . forward and f = 1
/// (c > 0) or backward. @param velocity any length; 1 for zero
double directional_factor(const Friction& friction, const std::array<double, 2>& velocity);

/// Velocity in the plane at the end of a step after friction, the implicit solution for one node: stable for any step, never more
/// than what stops the node.
/// @param before velocity at the start of the step, m/s; exactly zero: static friction
/// @param trial velocity that the node would reach without friction, m/s
/// @param normal_change step times normal force over mass, m/s, >= 0
std::array<double, 2> velocity_after_friction(const Friction& friction, const std::array<double, 2>& before,
                                              const std::array<double, 2>& trial, double normal_change);

}  // namespace menger::fem
