#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "meshes/design/polycube.h"
#include "voxel/engine/voxel_classes.h"
#include "voxel/laws/lattice.h"
#include "voxel/model/hollow_voxels.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// A body of voxels with everything that follows from its physics and that no step changes. It is the same for all number types.
struct VoxelBody {
  /// See Simulation. @param fixed per voxel, or empty
  VoxelBody(const meshes::Polycube& body, double cell_edge_m, const Physics& given, const std::vector<bool>& fixed);

  /// Returns the cell of the design that a voxel belongs to.
  [[nodiscard]] meshes::CellIndex cell_of(std::size_t voxel) const;

  Physics physics;
  std::optional<HollowVoxels> hollow;  ///< of a calibrated body
  Lattice lattice;
  double edge_m;  ///< of a voxel
  BodyClasses classes;
  std::vector<double> phases;  ///< of the drive of every voxel, in periods
  double time_step_s;
  double speed_limit_m_s;  ///< faster voxels have diverged
};

}  // namespace menger::voxel
