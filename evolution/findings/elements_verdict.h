#pragma once

#include <filesystem>
#include <string>

#include "meshes/robot/robot.h"

namespace menger::evolution {

// A body that walks stands on the ground where it is inflated, and on none where it is validated: its volume differs by that,
// too.

/// Returns " (inflate, on the ground)": the stage that inflates a robot, and on what.
std::string inflate_supports(const meshes::Robot& robot);

/// Returns " (validate, free)" likewise.
std::string validate_supports(const meshes::Robot& robot);

/// Returns how far the finite elements of the stages inflate and validate differ in the volume of the chamber at the pressure of
/// the drive; empty if they agree, or cannot be compared. @throws io::InputError if a result cannot be read
std::string elements_verdict(const std::filesystem::path& results, const meshes::Robot& robot);

}  // namespace menger::evolution
