#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// Returns what a stage found, in one sentence for people, from the files that it wrote; empty if they hold none.
/// @param results folder of the results of the loop
std::string stage_finding(const std::string& stage, const std::filesystem::path& results, const meshes::Robot& robot);

/// Returns that a robot gets more pressure than its body bears, so that no walk of it can be computed; empty unless it does.
/// @param results of the stages inflate and limit for this robot
std::string overdrive(const std::filesystem::path& results, const meshes::Robot& robot);

/// Returns that walls of a chamber touch before the first state in which the stage validate compares both models; empty unless
/// they do. @param results of the stage inflate for this robot
std::string early_contact(const std::filesystem::path& results, const meshes::Robot& robot);

/// Returns the pressure at which the body balloons by the softest law in the record of its silicone: limit pressures go nearly
/// with the shear modulus at rest. @return nothing if no limit pressure was found, or if no law is softer than the robot's
std::optional<double> softest_limit_Pa(const std::filesystem::path& results, const meshes::Robot& robot);

/// Returns what the results say together: whether the pressure is safe, whether both models walk alike, and how well the walk on
/// finite elements is known. One sentence each; none for results that are not there. Walks that ended early are not compared.
/// @param stages those whose results belong to this robot; files of others may be of an earlier one, and are not read
std::vector<std::string> loop_verdict(const std::filesystem::path& results, const meshes::Robot& robot,
                                      const std::set<std::string>& stages);

}  // namespace menger::evolution
