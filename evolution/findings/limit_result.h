#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "meshes/robot/robot.h"

namespace menger::evolution {

/// Returns the least pressure at which the body balloons: of the search for it, and of the inflation to the states of the drive,
/// where that ended so. @return nothing if neither found one
std::optional<double> limit_pressure_Pa(const std::filesystem::path& results);

/// Returns " (all chambers together)" where a limit pressure was found so, and the drive loads them by turns.
std::string where_at_limit(const std::filesystem::path& results, const meshes::Robot& robot, double limit_Pa);

/// Returns what the stage limit found, for people.
std::string limit_text(const std::filesystem::path& results, const meshes::Robot& robot);

}  // namespace menger::evolution
