#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// Returns how well the walk on finite elements is known, and whether the surrogate walks so, in sentences. Walks that ended
/// early are not compared.
/// @param stages those whose results belong to this robot
/// @throws io::InputError if a result cannot be read
std::vector<std::string> walk_verdict(const std::filesystem::path& results, const meshes::Robot& robot,
                                      const std::set<std::string>& stages);

}  // namespace menger::evolution
