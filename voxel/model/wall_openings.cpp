#include "voxel/model/wall_openings.h"

#include <cstddef>

#include "voxel/model/wall_squares.h"

namespace menger::voxel {

std::vector<std::array<double, 6>> wall_openings(const Lattice& lattice, const HollowVoxels& voxels) {
  std::vector<std::array<double, 6>> openings(lattice.voxel_count());
  for (std::size_t voxel = 0; voxel < openings.size(); ++voxel) {
    for (std::size_t side = 0; side < 6; ++side) {
      if (voxels.walled[voxel][side]) continue;
      const std::size_t u = 2 * ((side / 2 + 1) % 3);
      const std::size_t v = 2 * ((side / 2 + 2) % 3);
      for (const std::size_t beside : {u, u + 1}) {
        for (const std::size_t behind : {v, v + 1})
          openings[voxel][side] += plate_beside(lattice, voxels, voxel, side, beside, behind) ? 0.25 : 0.0;
      }
    }
  }
  return openings;
}

}  // namespace menger::voxel
