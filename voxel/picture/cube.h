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

/// The corners (m) of a voxel at rest, in the same order: a cube of the cell edge around its centre at rest.
std::array<std::array<double, 3>, cube_corner_count> rest_corners_m(const Frame& frame, std::size_t voxel);

/// The volume of a voxel as it is drawn, over that at rest.
double volume_ratio(const Frame& frame, std::size_t voxel);

}  // namespace menger::voxel
