#pragma once

#include <array>
#include <vector>

#include "voxel/laws/lattice.h"
#include "voxel/model/hollow_voxels.h"

namespace menger::voxel {

/// How far an open side lies in a plate: where a limb leaves a wide wall its neck rides on the wall's dome.
///
/// Per voxel and side (-x, +x, -y, ...) the share of the four quadrants around an open side, 0 ... 1, in which the three other
/// voxels of a square are of the same chamber and have a free wall on that side: 1 in the middle of a plate of 3 x 3 cells, 1/2
/// at its edge, 1/4 at its corner. 0 of a side with a wall, inside a wide body, whose cross section goes on, and in a tube. By
/// that share of the mean bulge that the wall has there (its bulge class) the half beam through the side is longer: the wall
/// stands out, and what opens into it with it.
std::vector<std::array<double, 6>> wall_openings(const Lattice& lattice, const HollowVoxels& voxels);

}  // namespace menger::voxel
