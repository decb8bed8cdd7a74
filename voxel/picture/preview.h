#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>

#include "io/picture/picture.h"
#include "voxel/engine/frame.h"
#include "voxel/scene/trajectory.h"

namespace menger::voxel {

/// Size and content of a picture of robots.
struct RobotStyle {
  io::PictureStyle picture{};
  bool floor = true;  ///< whether to draw the ground
  /// Of the picture of one robot. It then has a scale bar, says which colour is which material, and shows on the ground where x
  /// and y point.
  std::string title{};
};

/// Draws a robot as a PNG picture, seen from above at an angle: lit cubes on the ground, material 1 in blue, material 2 in
/// orange.
///
/// Renders off-screen on the available X display, or on a virtual one that is started for this purpose. If there is neither,
/// nothing is drawn and the outcome states what is missing. The bytes of a picture depend on the graphics library, so pictures
/// are only for viewing.
/// @param trail_m path of the centre of mass, drawn on the ground if given @throws io::InputError if the place cannot be written
io::PictureOutcome render_robot(const std::filesystem::path& file, const Frame& frame,
                                std::span<const std::array<double, 3>> trail_m = {}, const RobotStyle& style = {});

/// Draws robots side by side from left to right, all to the same scale. @param captions one per robot, or none
io::PictureOutcome render_row(const std::filesystem::path& file, std::span<const Frame> frames,
                              std::span<const std::string> captions = {},
                              const RobotStyle& style = {.picture = {.width_px = 2400, .height_px = 1100}});

/// Draws a trajectory of the centre of mass as a PNG picture with two charts: the horizontal displacement over time, and the path
/// seen from above with its start and end. Both are in body lengths. Draws nothing, and says so in the outcome, for fewer than
/// two points. @param name of the robot: the title
io::PictureOutcome plot_trajectory(const std::filesystem::path& file, const Trajectory& trajectory, double body_length_m,
                                   const std::string& name, const io::PictureStyle& style = {.width_px = 1600, .height_px = 800});

}  // namespace menger::voxel
