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
    corner,  ///< of the voxel, in the rim of a wall: it stays in the box of the voxel
    middle,  ///< of a wall, where it stands out most
    slope,   ///< middle of a wall that is the corner or the edge of a wide plate: it stands out most at its crowns
    crown,   ///< corner shared by four voxels of a chamber whose walls are one plate
  };
  Kind kind = Kind::corner;
  std::array<double, 3> signs{};     ///< of the voxel's half lengths, 0 for none: middles and slopes have one, the others three
  std::size_t axis = 0;              ///< across the wall; without meaning of a corner
  std::vector<std::size_t> bulging;  ///< voxels whose walls make the bulge: none of a corner, the four of a crown
  double share = 1.0;                ///< of a foot: each of the four voxels at a crown has a quarter of it
};

/// Middle and corners.
inline constexpr double feet_of_a_wall = 5.0;

/// How far walls of a voxel across an axis stand out, m; negative where they are drawn in.
struct WallBulge {
  double mean = 0.0;
  double peak = 0.0;
};

/// The feet of a voxel: the middles of all walls behind which no voxel lies, by side; the corners of those walls, each once, but
/// for those inside a plate, where no rim is; the crowns that it has a part in.
std::vector<WallFoot> wall_feet(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel);

/// How far a foot stands out of the box of its voxel, m: a corner not at all, a middle by the peak of its wall, a slope by its
/// mean, a crown by the mean of the four peaks. @param bulge_of (voxel, axis) -> WallBulge
template <class BulgeOf>
double stands_out_m(const WallFoot& foot, const BulgeOf& bulge_of) {
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
  for (const std::size_t voxel : foot.bulging) sum += bulge_of(voxel, foot.axis).peak;
  return sum / static_cast<double>(foot.bulging.size());
}

/// From the centre of a voxel that is not turned to a foot, m.
/// @param half_lengths_m of the voxel along x, y, z @param out_m see stands_out_m
inline Vector3<double> place_of(const WallFoot& foot, const std::array<double, 3>& half_lengths_m, double out_m) {
  std::array<double, 3> place{};
  for (std::size_t k = 0; k < 3; ++k) place[k] = foot.signs[k] * half_lengths_m[k];
  if (foot.kind != WallFoot::Kind::corner) place[foot.axis] += foot.signs[foot.axis] * out_m;
  return {place[0], place[1], place[2]};
}

}  // namespace menger::voxel
