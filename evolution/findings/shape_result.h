#pragma once

#include <filesystem>
#include <string>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// Returns what the stage validate found: how far the surrogate is off in the shape of the robot, for people.
std::string shape_text(const std::filesystem::path& results, const meshes::Robot& robot);

/// Returns whether the surrogate's shape of the robot is to be trusted, in a sentence; empty if it was not compared.
/// @throws io::InputError if a result cannot be read
std::string shape_verdict(const std::filesystem::path& results, const meshes::Robot& robot);

}  // namespace menger::evolution
