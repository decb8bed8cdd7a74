#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "voxel/laws/lattice.h"
#include "voxel/model/hollow_voxels.h"

namespace menger::voxel {

/// Whether a voxel has a wall on a side (-x, +x, -y, ...) behind which no voxel lies.
bool has_free_wall(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel, std::size_t side);

/// The three voxels that make a square with one, if they are of its chamber and have a free wall on `side`, so that their walls
/// are one plate: the neighbours on two sides parallel to the axis across, and the one diagonally between them.
std::optional<std::array<std::size_t, 3>> plate_beside(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel,
                                                       std::size_t side, std::size_t beside, std::size_t behind);

}  // namespace menger::voxel
