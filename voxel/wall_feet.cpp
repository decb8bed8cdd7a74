#include "voxel/wall_feet.h"

#include <algorithm>
#include <optional>

namespace menger::voxel {

namespace {

/// Sides of a voxel and of the lattice: lower 2 * axis, upper one more.
std::size_t side_of(std::size_t axis, bool upper) { return 2 * axis + (upper ? 1 : 0); }

double sign(bool upper) { return upper ? 1.0 : -1.0; }

bool is_free(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel, std::size_t side) {
  return voxels.walled[voxel][side] && lattice.neighbours[voxel][side] < 0;
}

std::optional<std::size_t> neighbour(const Lattice& lattice, std::size_t voxel, std::size_t side) {
  const std::int32_t other = lattice.neighbours[voxel][side];
  return other < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(other));
}

/// The four voxels of one chamber around an edge along `axis` if all of them have a free wall on `side`, else none.
std::vector<std::size_t> plate_around(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel, std::size_t side,
                                      std::size_t beside, std::size_t behind) {
  const auto first = neighbour(lattice, voxel, beside);
  const auto second = neighbour(lattice, voxel, behind);
  if (!first || !second) return {};
  const auto across = neighbour(lattice, *first, behind);
  if (!across) return {};
  std::vector<std::size_t> plate{voxel, *first, *second, *across};
  const bool is_one = std::ranges::all_of(plate, [&](std::size_t part) {
    return voxels.chamber[part] == voxels.chamber[voxel] && is_free(lattice, voxels, part, side);
  });
  if (!is_one) plate.clear();
  return plate;
}

void add_middle(std::vector<WallFoot>& feet, std::size_t voxel, std::size_t axis, bool upper) {
  WallFoot& foot = feet.emplace_back();
  foot.kind = WallFoot::Kind::middle;
  foot.axis = axis;
  foot.signs[axis] = sign(upper);
  foot.bulging = {voxel};
}

void add_crowns(std::vector<WallFoot>& feet, const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel,
                std::size_t axis, bool upper) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  for (const bool upper_u : {false, true}) {
    for (const bool upper_v : {false, true}) {
      std::vector<std::size_t> plate =
          plate_around(lattice, voxels, voxel, side_of(axis, upper), side_of(u, upper_u), side_of(v, upper_v));
      if (plate.empty()) continue;
      WallFoot& foot = feet.emplace_back();
      foot.kind = WallFoot::Kind::crown;
      foot.axis = axis;
      foot.signs[axis] = sign(upper);
      foot.signs[u] = sign(upper_u);
      foot.signs[v] = sign(upper_v);
      foot.bulging = std::move(plate);
      foot.share = 0.25;
    }
  }
}

}  // namespace

std::vector<WallFoot> wall_feet(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel) {
  std::vector<WallFoot> feet;
  for (std::size_t side = 0; side < 6; ++side) {
    if (is_free(lattice, voxels, voxel, side)) add_middle(feet, voxel, side / 2, side % 2 != 0);
  }
  for (std::size_t corner = 0; corner < 8; ++corner) {
    bool of_a_wall = false;
    WallFoot foot;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool upper = (corner >> axis & 1U) != 0;
      foot.signs[axis] = sign(upper);
      of_a_wall = of_a_wall || is_free(lattice, voxels, voxel, side_of(axis, upper));
    }
    if (of_a_wall) feet.push_back(foot);
  }
  for (std::size_t side = 0; side < 6; ++side) {
    if (is_free(lattice, voxels, voxel, side)) add_crowns(feet, lattice, voxels, voxel, side / 2, side % 2 != 0);
  }
  return feet;
}

}  // namespace menger::voxel
