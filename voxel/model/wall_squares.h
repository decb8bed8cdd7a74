#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "voxel/laws/lattice.h"
#include "voxel/model/hollow_voxels.h"

namespace menger::voxel {

/// Whether a voxel has a free wall on a side (-x, +x, -y, ...): a wall behind which no voxel lies.
bool has_free_wall(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel, std::size_t side);

/// Returns the three voxels that form a square with a voxel, if the walls of all four on `side` are one plate. The three are the
/// neighbours on the sides `beside` and `behind`, and the voxel diagonally between these. The walls are one plate if the three
/// belong to the voxel's chamber and have a free wall on `side`.
/// @param beside, behind two sides parallel to the axis across the wall
std::optional<std::array<std::size_t, 3>> plate_beside(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel,
                                                       std::size_t side, std::size_t beside, std::size_t behind);

}  // namespace menger::voxel
