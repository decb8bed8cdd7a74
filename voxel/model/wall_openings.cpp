#include "voxel/model/wall_openings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "voxel/model/wall_squares.h"

namespace menger::voxel {
namespace {

WallOpening opening_of(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel, std::size_t side, bool tilts) {
  const std::size_t axis = side / 2;
  const std::size_t u = 2 * ((axis + 1) % 3);
  const std::size_t v = 2 * ((axis + 2) % 3);
  WallOpening opening;
  for (const std::size_t upper_u : {std::size_t{0}, std::size_t{1}}) {
    for (const std::size_t upper_v : {std::size_t{0}, std::size_t{1}}) {
      const auto plate = plate_beside(lattice, voxels, voxel, side, u + upper_u, v + upper_v);
      if (!plate) continue;
      opening.lifts = true;
      for (const std::size_t other : {voxel, (*plate)[0], (*plate)[1], (*plate)[2]}) {
        const std::uint8_t c = voxels.bulge_class[other][axis];
        opening.lift[c] += 1.0 / 16.0;  // of four corners and of four voxels
        if (!tilts) continue;
        opening.turn[0][c] += upper_v == 1 ? 0.125 : -0.125;
        opening.turn[1][c] -= upper_u == 1 ? 0.125 : -0.125;
      }
    }
  }
  for (const ByLawClass<double>& turn : opening.turn)
    opening.tilts = opening.tilts || std::ranges::any_of(turn, [](double of_class) { return of_class != 0.0; });
  return opening;
}

}  // namespace

std::vector<std::array<WallOpening, 6>> wall_openings(const Lattice& lattice, const HollowVoxels& voxels, int voxels_per_cell) {
  std::vector<std::array<WallOpening, 6>> openings(lattice.voxel_count());
  for (std::size_t voxel = 0; voxel < openings.size(); ++voxel) {
    for (std::size_t side = 0; side < 6; ++side) {
      if (!voxels.walled[voxel][side]) openings[voxel][side] = opening_of(lattice, voxels, voxel, side, voxels_per_cell == 1);
    }
  }
  return openings;
}

bool has_tilted_limbs(const std::vector<std::array<WallOpening, 6>>& openings) {
  return std::ranges::any_of(openings, [](const auto& of_voxel) { return std::ranges::any_of(of_voxel, &WallOpening::tilts); });
}

}  // namespace menger::voxel
