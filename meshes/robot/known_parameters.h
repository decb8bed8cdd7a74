#pragma once

#include <filesystem>
#include <optional>

#include "meshes/robot/robot.h"

namespace menger::meshes {

/// Returns the voxel parameters that come with menger for exactly the robot's silicone with its recommended law, cell edge and
/// wall, with one voxel per cell; nothing if there are none.
std::optional<std::filesystem::path> known_parameters(const Robot& robot);

}  // namespace menger::meshes
