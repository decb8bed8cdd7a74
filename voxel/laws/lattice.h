#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshes/design/polycube.h"

namespace menger::voxel {

/// Beams along one axis in the order of their lower voxels.
struct AxisBeams {
  std::vector<std::int32_t> lower;  ///< voxel at the end with the smaller coordinate
  std::vector<std::int32_t> upper;
};

/// Voxels of a body and the beams between face neighbours, as index arrays.
///
/// Voxels stand in grid order (x fastest, then y, then z).
struct Lattice {
  explicit Lattice(const meshes::Polycube& body);

  std::vector<meshes::CellIndex> cells;                 ///< per voxel
  std::vector<meshes::Material> material;               ///< per voxel, 1 or 2
  std::array<AxisBeams, 3> beams;                       ///< along x, y, z
  std::vector<std::array<std::int32_t, 6>> neighbours;  ///< per voxel: -x, +x, -y, +y, -z, +z; -1 where there is none
  std::array<int, 3> grid{0, 0, 0};                     ///< size of the body's grid

  [[nodiscard]] std::size_t voxel_count() const { return cells.size(); }
  [[nodiscard]] std::size_t beam_count() const { return beams[0].lower.size() + beams[1].lower.size() + beams[2].lower.size(); }

  /// Returns the voxels with fewer than six beams, ascending.
  [[nodiscard]] std::vector<std::int32_t> surface() const;
};

}  // namespace menger::voxel
