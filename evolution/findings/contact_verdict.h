#pragma once

#include <filesystem>
#include <string>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// Returns whether the walls of chambers touch before a drive has come to its lowest pressure, on which elements; empty if it is
/// not known, or if the drive has no vacuum and none touch.
/// @param is_validated whether the results have a validation of this robot
/// @throws io::InputError if a result cannot be read
std::string contact_verdict(const std::filesystem::path& results, const meshes::Robot& robot, bool is_validated);

/// Returns that walls of a chamber touch before the first state in which the stage validate compares both models; empty unless
/// they do. @param results of the stage inflate for this robot; those that cannot be read count as none
std::string early_contact(const std::filesystem::path& results, const meshes::Robot& robot);

}  // namespace menger::evolution
