#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// Returns what the results say together: whether the pressure is safe, whether both models walk alike, and how well the walk on
/// finite elements is known. One sentence each; none for results that are not there. Walks that ended early are not compared.
/// @param stages those whose results belong to this robot; files of others may be of an earlier one, and are not read
std::vector<std::string> loop_verdict(const std::filesystem::path& results, const meshes::Robot& robot,
                                      const std::set<std::string>& stages);

}  // namespace menger::evolution
