#pragma once

#include <filesystem>
#include <string>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// Returns what a stage found, in one sentence for people, from the files that it wrote; empty if they hold none.
/// @param results folder of the results of the loop
std::string stage_finding(const std::string& stage, const std::filesystem::path& results, const meshes::Robot& robot);

}  // namespace menger::evolution
