#pragma once

#include <array>
#include <vector>

#include "voxel/laws/lattice.h"
#include "voxel/model/hollow_voxels.h"

namespace menger::voxel {

/// Returns how far each open side of a voxel lies inside a plate. Where a limb leaves a wide wall, its neck moves with the dome
/// of that wall.
///
/// The result has a share from 0 to 1 per voxel and side (-x, +x, -y, ...): the share of the four quadrants around an open side
/// that are part of a plate. A quadrant is part of a plate if the three other voxels of its square belong to the same chamber and
/// have a free wall on that side. The share is 1 in the middle of a plate of 3 x 3 cells, 1/2 at its edge and 1/4 at its corner.
/// It is 0 for a side with a wall, inside a wide body, where the cross section continues, and in a tube.
///
/// The half beam through an open side is longer by that share of the mean bulge that the wall has there (by its bulge class). The
/// wall stands out and takes with it what opens into it.
std::vector<std::array<double, 6>> wall_openings(const Lattice& lattice, const HollowVoxels& voxels);

}  // namespace menger::voxel
