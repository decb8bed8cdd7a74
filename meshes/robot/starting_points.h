#pragma once

#include <span>
#include <string>
#include <string_view>

namespace menger::meshes {

/// A robot to begin with.
struct StartingPoint {
  std::string_view name;     ///< "table"
  std::string_view purpose;  ///< what it is, for people
  std::string_view changes;  ///< in TOML, what its robot.toml says beside the defaults
};

/// Returns all of them.
std::span<const StartingPoint> starting_points();

/// Returns the text of a robot.toml: every key with its meaning, and the values of a starting point.
/// @param robot_name name of the robot
std::string robot_template(const StartingPoint& start, const std::string& robot_name);

}  // namespace menger::meshes
