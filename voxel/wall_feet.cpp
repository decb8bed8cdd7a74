#include "voxel/wall_feet.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

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

/// One that a plate has where four of its voxels meet.
WallFoot crown_of(std::vector<std::size_t> plate, std::size_t axis, const std::array<double, 3>& signs) {
  WallFoot foot;
  foot.kind = WallFoot::Kind::crown;
  foot.axis = axis;
  foot.signs = signs;
  foot.bulging = std::move(plate);
  foot.share = 0.25;
  return foot;
}

/// What a voxel has on one of its free sides.
struct SideFeet {
  std::vector<WallFoot> crowns;
  std::vector<std::array<double, 3>> rim;  ///< signs of the corners that no plate goes on beyond
};

SideFeet side_feet(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel, std::size_t axis, bool upper) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  SideFeet feet;
  for (const bool upper_u : {false, true}) {
    for (const bool upper_v : {false, true}) {
      std::array<double, 3> signs{};
      signs[axis] = sign(upper);
      signs[u] = sign(upper_u);
      signs[v] = sign(upper_v);
      std::vector<std::size_t> plate =
          plate_around(lattice, voxels, voxel, side_of(axis, upper), side_of(u, upper_u), side_of(v, upper_v));
      if (plate.empty()) {
        feet.rim.push_back(signs);
      } else {
        feet.crowns.push_back(crown_of(std::move(plate), axis, signs));
      }
    }
  }
  return feet;
}

WallFoot middle_of(std::size_t voxel, std::size_t axis, bool upper, bool is_slope) {
  WallFoot foot;
  foot.kind = is_slope ? WallFoot::Kind::slope : WallFoot::Kind::middle;
  foot.axis = axis;
  foot.signs[axis] = sign(upper);
  foot.bulging = {voxel};
  return foot;
}

}  // namespace

std::vector<WallFoot> wall_feet(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel) {
  std::vector<WallFoot> feet;
  std::vector<WallFoot> crowns;
  std::set<std::array<double, 3>> corners;  // those of two walls once
  for (std::size_t side = 0; side < 6; ++side) {
    if (!is_free(lattice, voxels, voxel, side)) continue;
    const std::size_t axis = side / 2;
    SideFeet on_side = side_feet(lattice, voxels, voxel, axis, side % 2 != 0);
    const std::uint8_t of_class = voxels.bulge_class[voxel][axis];
    const bool slopes = !on_side.crowns.empty() && (of_class == walls::corner || of_class == walls::one);
    feet.push_back(middle_of(voxel, axis, side % 2 != 0, slopes));
    corners.insert(on_side.rim.begin(), on_side.rim.end());
    std::move(on_side.crowns.begin(), on_side.crowns.end(), std::back_inserter(crowns));
  }
  for (const std::array<double, 3>& signs : corners) feet.emplace_back().signs = signs;
  std::move(crowns.begin(), crowns.end(), std::back_inserter(feet));
  return feet;
}

}  // namespace menger::voxel
