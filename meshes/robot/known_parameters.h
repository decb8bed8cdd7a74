#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "meshes/robot/robot.h"

namespace menger::meshes {

/// Returns in what the silicone and cells that voxel parameters were fitted for are not those of the robot: "cell_edge_m 0.012 in
/// place of 0.01". @throws io::InputError if it is no file of parameters
std::vector<std::string> other_subject_of(const std::filesystem::path& parameters, const Robot& robot);

/// Returns the voxel parameters that come with menger for exactly the robot's silicone with its recommended law, cell edge and
/// wall, with one voxel per cell; nothing if there are none.
std::optional<std::filesystem::path> known_parameters(const Robot& robot);

}  // namespace menger::meshes
