#pragma once

#include <array>
#include <cstddef>

#include "voxel/engine/frame.h"

namespace menger::voxel {

inline constexpr int cube_corner_count = 8;

/// Corners (m) of a voxel as an oriented box, centre + R(q) (±s/2, ±s/2, ±s/2) with its size or, where the frame has them, with
/// the reaches of its sides; in the order of VTK_HEXAHEDRON: the lower face counter-clockwise seen from above, starting at (-, -,
/// -), then the upper one.
std::array<std::array<double, 3>, cube_corner_count> cube_corners_m(const Frame& frame, std::size_t voxel);

}  // namespace menger::voxel
