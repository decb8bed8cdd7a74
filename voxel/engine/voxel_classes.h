#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "voxel/kernels/step_data.h"
#include "voxel/laws/lattice.h"
#include "voxel/model/hollow_voxels.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Coefficients of the classes of voxels (material, free or fixed) and of beams (materials at the two ends), computed in double.
struct ClassTables {
  std::vector<VoxelCoefficients<double>> voxel;  ///< index: material - 1, plus 2 if fixed
  std::vector<BeamCoefficients<double>> beam;    ///< index: material at the lower end - 1, plus 2 (material at the upper end - 1)
  std::vector<double> mass_kg;                   ///< per material
  std::vector<double> inertia_kg_m2;             ///< per material, m L^2 / 6
};

/// Tables of the materials of a physics and an edge (m). Damping from velocities gets the mean of its two ends' coefficients at
/// both, which conserves momentum.
ClassTables class_tables(const Physics& physics, double cell_edge_m);

/// The voxels and beams of a body by class: equal ones share a row of the tables.
struct BodyClasses {
  std::vector<VoxelCoefficients<double>> voxel;
  std::vector<BeamCoefficients<double>> beam;
  std::vector<std::size_t> voxel_class;                ///< per voxel
  std::array<std::vector<std::size_t>, 3> beam_class;  ///< per axis and beam
  std::vector<double> mass_kg;                         ///< per voxel
  std::vector<double> inertia_kg_m2;                   ///< per voxel
  std::size_t beam_of_uniform = 0;                     ///< class of a beam between two voxels like the first
  bool uniform = false;                                ///< one class of free voxels, one of beams
};

/// Classes of solid voxels, by material. @param fixed per voxel, or empty
BodyClasses solid_classes(const Lattice& lattice, double cell_edge_m, const Physics& physics, const std::vector<bool>& fixed);

/// Classes of a calibrated body (physics.surrogate), by what its walls make of each voxel and beam.
///
/// A voxel has the mass of its walls and m L^2 / 6 times their inertia factor. The floor presses back on the five feet of a wall
/// (FootContact), and other voxels on the whole, with ground_stiffness k_g and 2 zeta_c sqrt(m k_g / 2), which are 2 E L and
/// 2 zeta_c sqrt(m E L) of a solid voxel where k_g = 2 E L; its mean EA / L over the axes takes the place of E L in the damping
/// against the world.
BodyClasses calibrated_classes(const Lattice& lattice, const HollowVoxels& voxels, const Physics& physics,
                               const std::vector<bool>& fixed);

}  // namespace menger::voxel
