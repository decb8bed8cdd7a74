#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// Returns how a drive compares with the pressure at which the body balloons, in sentences.
/// @param is_inflated whether the results have an inflation up to the pressure of the drive
/// @param is_validated whether they have a validation of this robot
/// @throws io::InputError if a result cannot be read
std::vector<std::string> pressure_verdict(const std::filesystem::path& results, const meshes::Robot& robot, bool is_inflated,
                                          bool is_validated);

/// Returns that a robot gets more pressure than its body bears, so that no walk of it can be computed; empty unless it does.
/// @param results of the stages inflate and limit for this robot; those that cannot be read count as none
std::string overdrive(const std::filesystem::path& results, const meshes::Robot& robot);

/// Returns the pressure at which the body balloons by the softest law in the record of its silicone: limit pressures go nearly
/// with the shear modulus at rest. @return nothing if no limit pressure was found, if no law is softer than the robot's, or
/// if a result cannot be read
std::optional<double> softest_limit_Pa(const std::filesystem::path& results, const meshes::Robot& robot);

}  // namespace menger::evolution
