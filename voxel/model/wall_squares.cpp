#include "voxel/model/wall_squares.h"

#include <algorithm>
#include <cstdint>

namespace menger::voxel {

bool has_free_wall(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel, std::size_t side) {
  return voxels.walled[voxel][side] && lattice.neighbours[voxel][side] < 0;
}

std::optional<std::array<std::size_t, 3>> plate_beside(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel,
                                                       std::size_t side, std::size_t beside, std::size_t behind) {
  const std::int32_t first = lattice.neighbours[voxel][beside];
  const std::int32_t second = lattice.neighbours[voxel][behind];
  if (first < 0 || second < 0) return std::nullopt;
  const std::int32_t across = lattice.neighbours[static_cast<std::size_t>(first)][behind];
  if (across < 0) return std::nullopt;
  const std::array<std::size_t, 3> others{static_cast<std::size_t>(first), static_cast<std::size_t>(second),
                                          static_cast<std::size_t>(across)};
  const bool is_plate = std::ranges::all_of(others, [&](std::size_t other) {
    return voxels.chamber[other] == voxels.chamber[voxel] && has_free_wall(lattice, voxels, other, side);
  });
  return is_plate ? std::optional(others) : std::nullopt;
}

}  // namespace menger::voxel
