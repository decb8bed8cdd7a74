#pragma once

#include <filesystem>
#include <vector>

#include "io/picture/picture.h"
#include "voxel/engine/frame.h"

namespace menger::evolution {

/// A body in both models at one time.
struct FramePair {
  double time_s = 0.0;
  std::filesystem::path elements;  ///< grid (.vtu) with displaced points; the ground is at height 0
  voxel::Frame surrogate;
};

/// Draws pairs from left to right, finite elements above and the surrogate below, at the same scale, seen from above at an angle.
/// Every body is on a tile that shows the same part of the ground, so that its displacement can be seen.
/// @throws io::InputError if a grid cannot be read or the place cannot be written
io::PictureOutcome draw_strip(const std::filesystem::path& file, const std::vector<FramePair>& pairs,
                              const io::PictureStyle& style = {.width_px = 2400, .height_px = 1000});

}  // namespace menger::evolution
