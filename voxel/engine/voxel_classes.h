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

/// Returns the tables of the materials of a physics for an edge (m). With damping from velocities both ends of a beam get the
/// mean of their two coefficients, which conserves momentum.
ClassTables class_tables(const Physics& physics, double cell_edge_m);

/// The classes of the voxels and beams of a body. Equal ones share a row of the tables.
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

/// Returns the classes of solid voxels, by material.
/// @param fixed per voxel, or empty
BodyClasses solid_classes(const Lattice& lattice, double cell_edge_m, const Physics& physics, const std::vector<bool>& fixed);

/// Returns the classes of a calibrated body (physics.surrogate), by the walls of each voxel and beam.
///
/// A voxel has the mass of its walls and the moment of inertia m L^2 / 6 times their inertia factor. The floor acts on the five
/// feet of a wall (FootContact), other voxels act on the whole voxel. Both act with the stiffness k_g = ground_stiffness and the
/// damping 2 zeta_c sqrt(m k_g / 2). Where k_g = 2 E L these are the 2 E L and 2 zeta_c sqrt(m E L) of a solid voxel. In the
/// damping against the world the mean of EA / L over the axes takes the place of E L.
BodyClasses calibrated_classes(const Lattice& lattice, const HollowVoxels& voxels, const Physics& physics,
                               const std::vector<bool>& fixed);

}  // namespace menger::voxel
