#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// Returns what a stage found, in one sentence for people, from the files that it wrote; empty if they hold none.
/// @param results folder of the results of the loop
std::string stage_finding(const std::string& stage, const std::filesystem::path& results, const meshes::Robot& robot);

/// Returns what the results say together: whether the pressure is safe, whether both models walk alike, and how well the walk on
/// finite elements is known. One sentence each; none for results that are not there.
std::vector<std::string> loop_verdict(const std::filesystem::path& results, const meshes::Robot& robot);

}  // namespace menger::evolution
