#include "voxel/model/elbows.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "voxel/model/wall_squares.h"

namespace menger::voxel {
namespace {

/// Whether a side of a voxel lies in a plate.
bool lies_in_plate(const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel, std::size_t side) {
  const std::size_t u = 2 * ((side / 2 + 1) % 3);
  const std::size_t v = 2 * ((side / 2 + 2) % 3);
  for (const std::size_t beside : {u, u + 1}) {
    for (const std::size_t behind : {v, v + 1}) {
      if (plate_beside(lattice, voxels, voxel, side, beside, behind)) return true;
    }
  }
  return false;
}

/// Adds the turns of the beam through a side of a voxel for the edges at that voxel.
void add_turns(AcrossBeam<double>& turn, const Lattice& lattice, const HollowVoxels& voxels, std::size_t voxel,
               std::size_t neighbour, std::size_t side) {
  if (lies_in_plate(lattice, voxels, voxel, side)) return;
  const std::size_t axis = side / 2;
  for (std::size_t other = 0; other < 6; ++other) {
    if (other / 2 == axis || lattice.neighbours[voxel][other] < 0 || lattice.neighbours[neighbour][other] >= 0) continue;
    if (lies_in_plate(lattice, voxels, voxel, other)) continue;
    // Whichever end the voxel is at: the walls on this side move apart along the beam.
    const double away = other % 2 == 1 ? 1.0 : -1.0;
    if (other / 2 == (axis + 1) % 3) {
      turn[1] -= away;
    } else {
      turn[0] += away;
    }
  }
}

}  // namespace

std::array<std::vector<AcrossBeam<double>>, 3> elbow_turns(const Lattice& lattice, const HollowVoxels& voxels,
                                                           int voxels_per_cell) {
  std::array<std::vector<AcrossBeam<double>>, 3> turns;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice.beams[axis];
    turns[axis].resize(beams.lower.size());
    for (std::size_t beam = 0; beam < beams.lower.size() && voxels_per_cell == 1; ++beam) {
      const auto lower = static_cast<std::size_t>(beams.lower[beam]);
      const auto upper = static_cast<std::size_t>(beams.upper[beam]);
      add_turns(turns[axis][beam], lattice, voxels, lower, upper, 2 * axis + 1);
      add_turns(turns[axis][beam], lattice, voxels, upper, lower, 2 * axis);
    }
  }
  return turns;
}

bool has_elbows(const std::array<std::vector<AcrossBeam<double>>, 3>& turns) {
  const auto is_turned = [](const AcrossBeam<double>& turn) { return turn[0] != 0.0 || turn[1] != 0.0; };
  return std::ranges::any_of(turns, [&](const auto& of_axis) { return std::ranges::any_of(of_axis, is_turned); });
}

}  // namespace menger::voxel
