#pragma once

#include <vector>

#include "voxel/lattice.h"
#include "voxel/parameters.h"
#include "voxel/step_data.h"

namespace menger::voxel {

/// Coefficients of the classes of voxels (material, free or fixed) and of beams (materials at the two ends), computed in double.
struct ClassTables {
  std::vector<VoxelCoefficients<double>> voxel;  ///< index: material - 1, plus 2 if fixed
  std::vector<BeamCoefficients<double>> beam;    ///< index: material at the lower end - 1, plus 2 (material at the upper end - 1)
  std::vector<double> mass_kg;                   ///< per material
  std::vector<double> inertia_kg_m2;             ///< per material, m L^2 / 6
};

/// Tables of a physics and an edge (m). Damping from velocities gets the mean of its two ends' coefficients at both, which
/// conserves momentum.
ClassTables class_tables(const Physics& physics, double cell_edge_m);

}  // namespace menger::voxel
