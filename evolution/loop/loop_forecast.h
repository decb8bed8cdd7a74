#pragma once

#include <string>
#include <vector>

#include "meshes/robot/robot_studies.h"

namespace menger::evolution {

/// Returns what to expect of the surrogate before anything runs: where its parameters come from, and what `menger simulate` or,
/// without a body yet, `menger evolve` says of its error for such a body.
/// @throws io::InputError if the parameters cannot be read
std::vector<std::string> loop_forecast(const meshes::Robot& robot, const meshes::RobotPlaces& places);

}  // namespace menger::evolution
