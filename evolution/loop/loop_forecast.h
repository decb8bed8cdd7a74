#pragma once

#include <string>
#include <vector>

#include "meshes/robot/robot_studies.h"

namespace menger::evolution {

/// Returns what to know before anything runs: where the law of the silicone comes from and how far other laws of it are, where
/// the parameters of the surrogate come from, and what `menger simulate` or,
/// without a body yet, `menger evolve` says of its error for such a body.
/// @throws io::InputError if the parameters cannot be read
std::vector<std::string> loop_forecast(const meshes::Robot& robot, const meshes::RobotPlaces& places);

}  // namespace menger::evolution
