#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "voxel/laws/lattice.h"
#include "voxel/laws/rotation.h"
#include "voxel/model/hollow_voxels.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// A point of a voxel's free walls that can stand on the ground.
struct WallFoot {
  enum class Kind : std::uint8_t {
    corner,  ///< of the voxel, in the rim of a wall; does not bulge
    middle,  ///< of a wall, where the wall stands out most
    slope,   ///< middle of a wall at the corner or the edge of a wide plate, which stands out most at its crowns
    crown,   ///< corner shared by four voxels of a chamber whose walls are one plate
  };
  Kind kind = Kind::corner;
  /// Signs of the voxel's half lengths, 0 for none. Middles and slopes have one sign, corners and crowns have three.
  std::array<double, 3> signs{};
  std::size_t axis = 0;              ///< across the wall; without meaning for a corner
  std::vector<std::size_t> bulging;  ///< voxels whose walls make the bulge: none for a corner, four for a crown
  double share = 1.0;                ///< of a foot: a quarter for each of the four voxels at a crown
};

/// The number of feet of a wall that is not part of a plate: its middle and its four corners.
inline constexpr double feet_of_a_wall = 5.0;

/// How far the walls of a voxel across an axis stand out, m; negative where they are drawn in.
struct WallBulge {
  double mean = 0.0;
  double peak = 0.0;
};

/// Returns the feet of a voxel. First the middles of all walls with no voxel behind them, by side. Then the corners of those
/// walls, each once, except those inside a plate, where there is no rim. Last the crowns that the voxel shares.
std::vector<WallFoot> wall_feet(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel);

/// Returns how far a foot stands out of the box of its voxel, m. A corner does not stand out, a middle does by the peak of its
/// wall, a slope by the mean of its wall, and a crown by the mean of the four peaks.
/// @param bulge_of (voxel, axis) -> WallBulge
/// @param foot a WallFoot, or its like
template <class Foot, class BulgeOf>
MENGER_HOST_DEVICE double stands_out_m(const Foot& foot, const BulgeOf& bulge_of) {
  switch (foot.kind) {
    case WallFoot::Kind::corner:
      return 0.0;
    case WallFoot::Kind::middle:
      return bulge_of(foot.bulging.front(), foot.axis).peak;
    case WallFoot::Kind::slope:
      return bulge_of(foot.bulging.front(), foot.axis).mean;
    case WallFoot::Kind::crown:
      break;
  }
  double sum = 0.0;
  for (const auto voxel : foot.bulging) sum += bulge_of(voxel, foot.axis).peak;
  return sum / static_cast<double>(foot.bulging.size());
}

/// Returns the vector from the centre of a voxel to a foot, m, for a voxel that is not turned.
/// @param half_lengths_m of the voxel along x, y, z
/// @param out_m see stands_out_m
template <class Foot>
MENGER_HOST_DEVICE Vector3<double> place_of(const Foot& foot, const std::array<double, 3>& half_lengths_m, double out_m) {
  double place[3] = {};
  for (std::size_t k = 0; k < 3; ++k) place[k] = foot.signs[k] * half_lengths_m[k];
  if (foot.kind != WallFoot::Kind::corner) place[foot.axis] += foot.signs[foot.axis] * out_m;
  return {place[0], place[1], place[2]};
}

}  // namespace menger::voxel
