#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshes/design/hollow_body_options.h"
#include "meshes/design/polycube.h"

namespace menger::voxel {

/// Which part of a hollow body a voxel lattice stands for.
struct HollowOptions {
  double cell_edge_m = 0.0;
  double wall_thickness_m = 0.0;
  int voxels_per_cell = 1;  ///< along an edge, >= 1
  int level = 1;            ///< of the fractal; modules of level >= 2 are hollow bodies of their own, bonded face to face
  meshes::ChamberLayout chambers = meshes::ChamberLayout::single;
};

/// The walls of a hollow body as its voxels see them.
///
/// All arrays have one entry per voxel in grid order of `body`. Axes 0, 1, 2 are x, y, z; sides 0 ... 5 are -x, +x, -y, +y, -z,
/// +z.
struct HollowVoxels {
  meshes::Polycube body;                    ///< every cell of the fractal split into voxels_per_cell^3 voxels
  std::vector<std::array<bool, 6>> walled;  ///< sides with a wall: at the end of the body, of a module or of a chamber
  std::vector<std::array<bool, 6>>
      shared;  ///< of those the sides whose wall parts two chambers of a module: half of it lies here
  std::vector<std::array<std::uint8_t, 3>> wall_class;  ///< per axis, see wall_class_names
  std::vector<std::array<std::uint8_t, 3>>
      bulge_class;                   ///< per axis: the class by which its faces across the axis bulge, see surrogate_parameters.h
  std::vector<std::size_t> chamber;  ///< air space of the voxel, by module and first cell
  std::size_t chamber_count = 0;
  std::vector<double> wall_volume_m3;  ///< silicone in the voxel, from the exact geometry; 0 well inside a chamber
  std::vector<double> inertia_factor;  ///< second moment of the wall about the voxel's centre, mean over the axes, by
                                       ///< that of a solid cube of the same mass (1 for a solid voxel)
};

/// Divides a body into voxels with walls as meshes::hollow_polycube casts it (tube holes and holes in joints left out).
/// @throws std::invalid_argument if the wall is not thinner than half a cell or a cell has no voxel
HollowVoxels hollow_voxels(const meshes::Polycube& basal_body, const HollowOptions& options);

/// Masses of voxels, kg: wall volume times density, but at least `smallest_share` (< 1) of the mean, the others scaled down so
/// that the body keeps its mass; a voxel without a wall would have none, and could not be stepped.
std::vector<double> voxel_masses(const HollowVoxels& voxels, double density_kg_m3, double smallest_share = 0.1);

}  // namespace menger::voxel
