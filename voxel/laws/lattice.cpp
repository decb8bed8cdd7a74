#include "voxel/laws/lattice.h"

#include <algorithm>

namespace menger::voxel {

Lattice::Lattice(const meshes::Polycube& body) : grid{body.nx(), body.ny(), body.nz()} {
  cells = body.occupied();
  material.reserve(cells.size());
  std::vector<std::int32_t> index(
      static_cast<std::size_t>(body.nx()) * static_cast<std::size_t>(body.ny()) * static_cast<std::size_t>(body.nz()), -1);
  const auto offset = [&](const meshes::CellIndex& cell) {
    return static_cast<std::size_t>(cell.x) +
           static_cast<std::size_t>(body.nx()) *
               (static_cast<std::size_t>(cell.y) + static_cast<std::size_t>(body.ny()) * static_cast<std::size_t>(cell.z));
  };
  for (std::size_t i = 0; i < cells.size(); ++i) {
    index[offset(cells[i])] = static_cast<std::int32_t>(i);
    material.push_back(body.at(cells[i]));
  }
  neighbours.assign(cells.size(), {-1, -1, -1, -1, -1, -1});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      meshes::CellIndex next = cells[i];
      (axis == 0 ? next.x : axis == 1 ? next.y : next.z) += 1;
      if (body.at_or_empty(next) == meshes::empty) continue;
      const std::int32_t upper = index[offset(next)];
      const auto lower = static_cast<std::int32_t>(i);
      beams[axis].lower.push_back(lower);
      beams[axis].upper.push_back(upper);
      neighbours[i][2 * axis + 1] = upper;
      neighbours[static_cast<std::size_t>(upper)][2 * axis] = lower;
    }
  }
}

std::vector<std::int32_t> Lattice::surface() const {
  std::vector<std::int32_t> voxels;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    if (std::any_of(neighbours[i].begin(), neighbours[i].end(), [](std::int32_t other) { return other < 0; })) {
      voxels.push_back(static_cast<std::int32_t>(i));
    }
  }
  return voxels;
}

}  // namespace menger::voxel
