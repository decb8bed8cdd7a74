#pragma once

#include <vtkPolyData.h>

#include <filesystem>
#include <string>

#include "io/picture/picture.h"
#include "voxel/validation/body_boxes.h"

namespace menger::voxel {

/// What is drawn side by side.
struct SideBySidePicture {
  vtkPolyData* elements = nullptr;  ///< deformed surface of finite elements; nullptr: the surrogate alone
  const BodyBoxes* surrogate = nullptr;
  const BodyBoxes* rest = nullptr;  ///< the body at rest, where both are; its outline is drawn
  std::string caption{};            ///< below both
  std::string finding{};            ///< above both
};

/// Draws both bodies at one scale, seen from above at an angle, with the outline of the body at rest and a scale bar.
/// @throws io::InputError if the place cannot be written
io::PictureOutcome draw_side_by_side(const std::filesystem::path& file, const SideBySidePicture& picture,
                                     const io::PictureStyle& style = {.width_px = 2000, .height_px = 1000});

}  // namespace menger::voxel
