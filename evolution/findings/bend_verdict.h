#pragma once

#include <filesystem>
#include <string>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// Says how far a body that does not walk bends at the strongest pressure of its drive, by the elements of stage inflate and by
/// both models of stage validate, and how far the surrogate is off. Empty for a body that walks, and where a stage did not reach
/// that pressure.
/// @param results folder of the results of the loop
std::string bend_verdict(const std::filesystem::path& results, const meshes::Robot& robot);

}  // namespace menger::evolution
