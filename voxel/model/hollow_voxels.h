#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshes/design/hollow_body_options.h"
#include "meshes/design/polycube.h"
#include "voxel/model/wall_classes.h"

namespace menger::voxel {

/// How a hollow body is cast and divided into voxels.
struct HollowOptions {
  double cell_edge_m = 0.0;
  double wall_thickness_m = 0.0;
  int voxels_per_cell = 1;  ///< along an edge, >= 1
  int level = 1;            ///< of the fractal; at level >= 2 its modules are hollow bodies of their own, bonded face to face
  meshes::ChamberLayout chambers = meshes::ChamberLayout::single;
};

/// A hollow body divided into voxels, with the walls of each voxel.
///
/// All arrays have one entry per voxel in grid order of `body`. Axes 0, 1, 2 are x, y, z; sides 0 ... 5 are -x, +x, -y, +y, -z,
/// +z.
struct HollowVoxels {
  meshes::Polycube body;                    ///< every cell of the fractal split into voxels_per_cell^3 voxels
  std::vector<std::array<bool, 6>> walled;  ///< sides with a wall: at the end of the body, of a module or of a chamber
  /// Which of the walled sides separate two chambers of one module. Half of such a wall lies in this voxel.
  std::vector<std::array<bool, 6>> shared;
  std::vector<std::array<std::uint8_t, 3>> wall_class;  ///< per axis, see wall_class_names
  /// Per side: the law class of the half beam there, or of the length up to the wall there.
  std::vector<std::array<std::uint8_t, 6>> half_class;
  /// Per axis: the law class of both halves, by which feet and contacts follow (VoxelClasses::size).
  std::vector<std::array<std::uint8_t, 3>> size_class;
  /// Per axis: the law class by which the faces of the voxel across the axis bulge.
  std::vector<std::array<std::uint8_t, 3>> bulge_class;
  std::vector<std::size_t> chamber;  ///< chamber of the voxel; numbered by module and first cell
  std::size_t chamber_count = 0;
  std::vector<double> wall_volume_m3;  ///< silicone in the voxel, from the exact geometry; 0 deep inside a chamber
  /// Second moment of the wall about the centre of the voxel, mean over the axes, divided by that of a solid cube of the same
  /// mass. 1 for a solid voxel.
  std::vector<double> inertia_factor;
};

/// Divides a body into voxels, with the walls that meshes::hollow_polycube casts. Holes for tubes and holes in joints are left
/// out.
/// @throws std::invalid_argument if the wall is not thinner than half a cell or a cell has no voxel
HollowVoxels hollow_voxels(const meshes::Polycube& basal_body, const HollowOptions& options);

/// Returns which law classes the voxels have, of their halves, their walls or their bulges.
ByLawClass<bool> law_classes_of(const HollowVoxels& voxels);

/// Returns the masses of the voxels, kg: wall volume times density, but at least `smallest_share` (< 1) of the mean mass. The
/// other masses are scaled down so that the body keeps its mass. Without this bound a voxel without a wall would have no mass and
/// could not be stepped.
std::vector<double> voxel_masses(const HollowVoxels& voxels, double density_kg_m3, double smallest_share = 0.1);

}  // namespace menger::voxel
