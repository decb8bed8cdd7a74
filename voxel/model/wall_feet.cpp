#include "voxel/model/wall_feet.h"

#include <iterator>
#include <set>
#include <utility>

#include "voxel/model/wall_squares.h"

namespace menger::voxel {

namespace {

/// Returns the index of a side: 2 * axis for the lower one, 2 * axis + 1 for the upper one.
std::size_t side_of(std::size_t axis, bool upper) { return 2 * axis + (upper ? 1 : 0); }

double sign(bool upper) { return upper ? 1.0 : -1.0; }

/// Returns the crown of a plate at the corner where four of its voxels meet.
WallFoot crown_of(std::vector<std::size_t> plate, std::size_t axis, const std::array<double, 3>& signs) {
  WallFoot foot;
  foot.kind = WallFoot::Kind::crown;
  foot.axis = axis;
  foot.signs = signs;
  foot.bulging = std::move(plate);
  foot.share = 0.25;
  return foot;
}

/// The crowns and the corners that a voxel has on one of its free sides.
struct SideFeet {
  std::vector<WallFoot> crowns;
  std::vector<std::array<double, 3>> rim;  ///< signs of the corners beyond which no plate continues
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
      const auto plate = plate_beside(lattice, voxels, voxel, side_of(axis, upper), side_of(u, upper_u), side_of(v, upper_v));
      if (plate) {
        feet.crowns.push_back(crown_of({voxel, (*plate)[0], (*plate)[1], (*plate)[2]}, axis, signs));
      } else {
        feet.rim.push_back(signs);
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
  std::set<std::array<double, 3>> corners;  // a corner of two walls counts once
  for (std::size_t side = 0; side < 6; ++side) {
    if (!has_free_wall(lattice, voxels, voxel, side)) continue;
    const std::size_t axis = side / 2;
    SideFeet on_side = side_feet(lattice, voxels, voxel, axis, side % 2 != 0);
    const std::size_t of_class = wall_class_of(voxels.bulge_class[voxel][axis]);
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
