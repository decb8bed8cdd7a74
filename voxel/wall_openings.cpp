#include "voxel/wall_openings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace menger::voxel {

namespace {

/// Whether the three voxels beside, behind and across a side are one plate with a free wall on it.
bool is_in_plate(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel, std::size_t side, std::size_t beside,
                 std::size_t behind) {
  const std::int32_t first = lattice.neighbours[voxel][beside];
  const std::int32_t second = lattice.neighbours[voxel][behind];
  const std::int32_t across = first < 0 ? -1 : lattice.neighbours[static_cast<std::size_t>(first)][behind];
  return std::ranges::all_of(std::array{first, second, across}, [&](std::int32_t part) {
    if (part < 0) return false;
    const auto at = static_cast<std::size_t>(part);
    return voxels.chamber[at] == voxels.chamber[voxel] && voxels.walled[at][side] && lattice.neighbours[at][side] < 0;
  });
}

}  // namespace

std::vector<std::array<double, 6>> wall_openings(const Lattice& lattice, const HollowVoxels& voxels) {
  std::vector<std::array<double, 6>> openings(lattice.voxel_count());
  for (std::size_t voxel = 0; voxel < openings.size(); ++voxel) {
    for (std::size_t side = 0; side < 6; ++side) {
      if (voxels.walled[voxel][side]) continue;
      const std::size_t u = 2 * ((side / 2 + 1) % 3);
      const std::size_t v = 2 * ((side / 2 + 2) % 3);
      for (const std::size_t beside : {u, u + 1}) {
        for (const std::size_t behind : {v, v + 1})
          openings[voxel][side] += is_in_plate(lattice, voxels, voxel, side, beside, behind) ? 0.25 : 0.0;
      }
    }
  }
  return openings;
}

}  // namespace menger::voxel
