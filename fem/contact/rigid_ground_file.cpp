#include "fem/contact/rigid_ground_file.h"

#include <cmath>

namespace menger::fem {
namespace {

void describe(io::StudyVisitor& visitor, DirectionalFriction& friction) {
  visitor.numbers(
      {"forward", "Vector in the plane, of any length. Friction is as given for sliding in this direction.", "[1, 0]"},
      friction.forward);
  visitor.check(std::hypot(friction.forward[0], friction.forward[1]) > 0.0, "forward", "must be two numbers that are not both 0");
  visitor.number({"backward_factor", "Factor on the friction for sliding against forward."}, friction.backward_factor,
                 io::non_negative());
  visitor.number({"sideways_factor", "Factor on the friction for sliding across forward."}, friction.sideways_factor,
                 io::non_negative());
}

}  // namespace

RigidGround StudyGround::ground(double usual_height_m, double usual_stiffness_Pa_per_m) const {
  RigidGround ground{.height_m = height_m.value_or(usual_height_m),
                     .stiffness_Pa_per_m = stiffness_Pa_per_m.value_or(usual_stiffness_Pa_per_m),
                     .friction = friction};
  if (!ground.friction.directional) return ground;
  auto& forward = ground.friction.directional->forward;
  const double length = std::hypot(forward[0], forward[1]);
  forward = {forward[0] / length, forward[1] / length};
  return ground;
}

void describe(io::StudyVisitor& visitor, StudyGround& ground) {
  Friction& friction = ground.friction;
  visitor.number({.name = "kinetic_friction",
                  .help = "Coefficient of friction while sliding.",
                  .example = "0.5",
                  .earlier = "kinetic_coefficient"},
                 friction.kinetic_coefficient, io::non_negative());
  visitor.number({.name = "static_friction",
                  .help = "Coefficient of friction at rest, at least the kinetic one.",
                  .example = "1",
                  .earlier = "static_coefficient"},
                 friction.static_coefficient, io::at_least(friction.kinetic_coefficient));
  visitor.optional_number({"height_m", "Height of the ground. If not given: the height of the body's lowest point.", "0"},
                          ground.height_m);
  visitor.optional_number(
      {"stiffness_Pa_per_m", "Pressure of the ground divided by depth. If not given: a fraction of the stiffness of an element.",
       "6e7"},
      ground.stiffness_Pa_per_m, io::positive());
  visitor.number(
      {"regularisation_speed_m_per_s", "Friction grows with the speed up to this speed. 0: points at rest stay at rest."},
      friction.regularisation_speed_m_per_s, io::non_negative());
  visitor.optional_table({"directional", "Friction that depends on the direction of sliding."}, friction.directional,
                         [&](DirectionalFriction& directional) { describe(visitor, directional); });
}

}  // namespace menger::fem
