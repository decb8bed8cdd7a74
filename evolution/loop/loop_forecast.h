#pragma once

#include <string>
#include <vector>

#include "meshes/robot/robot_studies.h"

namespace menger::evolution {

/// Returns what to know before anything runs: where the law of the silicone comes from and how far other laws of it are, where
/// the parameters of the surrogate come from, and what `menger simulate` or,
/// without a body yet, `menger evolve` says of its error for such a body.
/// @param is_found whether the body of a robot that evolves is that which its search has found now; another run may find another
/// @throws io::InputError if the parameters cannot be read
std::vector<std::string> loop_forecast(const meshes::Robot& robot, const meshes::RobotPlaces& places, bool is_found = false);

}  // namespace menger::evolution
