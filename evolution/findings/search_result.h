#pragma once

#include <filesystem>
#include <string>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// Returns what the stage evolve found, for people.
std::string search_text(const std::filesystem::path& results);

/// Returns which robot of a search is the best, and how far it goes on which elements; empty if the search has not told.
std::string search_verdict(const std::filesystem::path& results, const meshes::Robot& robot);

}  // namespace menger::evolution
