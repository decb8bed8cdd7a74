#pragma once

#include <array>
#include <cstddef>

#include "voxel/engine/frame.h"

namespace menger::voxel {

inline constexpr int cube_corner_count = 8;

/// The corners (m) of a voxel as an oriented box: centre + R(q) (±s/2, ±s/2, ±s/2) with its size s, or with the reaches of its
/// sides if the frame has them.
///
/// The order is that of VTK_HEXAHEDRON: first the lower face, counter-clockwise seen from above, starting at (-, -, -), then the
/// upper face.
std::array<std::array<double, 3>, cube_corner_count> cube_corners_m(const Frame& frame, std::size_t voxel);

}  // namespace menger::voxel
