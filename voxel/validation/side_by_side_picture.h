#pragma once

#include <vtkPolyData.h>

#include <filesystem>
#include <string>

#include "io/picture/picture.h"
#include "voxel/validation/body_boxes.h"

namespace menger::voxel {

/// Draws the deformed surface of finite elements and the boxes of a surrogate side by side, at one scale, seen from above at an
/// angle. @param elements nullptr: draw the surrogate alone @param caption shown below both
/// @throws io::InputError if the place cannot be written
io::PictureOutcome draw_side_by_side(const std::filesystem::path& file, vtkPolyData* elements, const BodyBoxes& surrogate,
                                     const std::string& caption,
                                     const io::PictureStyle& style = {.width_px = 2000, .height_px = 1000});

}  // namespace menger::voxel
