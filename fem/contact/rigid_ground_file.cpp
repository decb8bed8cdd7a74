#include "fem/contact/rigid_ground_file.h"

#include <cmath>
#include <vector>

namespace menger::fem {
namespace {

DirectionalFriction read_directional(const io::TomlTable& table) {
  const std::vector<double> forward = table.numbers("forward");
  const double length = forward.size() == 2 ? std::hypot(forward[0], forward[1]) : 0.0;
  if (length == 0.0) throw table.error("forward", "must be two numbers that are not both 0");
  return {.forward = {forward[0] / length, forward[1] / length},
          .backward_factor = table.number_or("backward_factor", 1.0, io::non_negative()),
          .sideways_factor = table.number_or("sideways_factor", 1.0, io::non_negative())};
}

}  // namespace

RigidGround read_rigid_ground(const io::TomlTable& table, double stiffness_Pa_per_m) {
  RigidGround ground;
  ground.height_m = table.number_or("height_m", 0.0);
  ground.stiffness_Pa_per_m = table.number_or("stiffness_Pa_per_m", stiffness_Pa_per_m, io::positive());
  ground.friction.kinetic_coefficient = table.number("kinetic_coefficient", io::non_negative());
  ground.friction.static_coefficient = table.number("static_coefficient", io::at_least(ground.friction.kinetic_coefficient));
  ground.friction.regularisation_speed_m_per_s = table.number_or("regularisation_speed_m_per_s", 0.0, io::non_negative());
  if (const auto directional = table.optional_table("directional")) ground.friction.directional = read_directional(*directional);
  return ground;
}

}  // namespace menger::fem
