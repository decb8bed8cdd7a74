#pragma once

#include "voxel/lattice.h"
#include "voxel/parameters.h"

namespace menger::voxel {

/// Mass of a voxel, rho L^3, kg.
double voxel_mass_kg(const VoxelMaterial& material, double cell_edge_m);

/// Modulus of a beam between two materials, the harmonic mean 2 E1 E2 / (E1 + E2), Pa.
double beam_modulus_Pa(const VoxelMaterial& a, const VoxelMaterial& b);

/// Recommended step of a lattice, s: 1 / (2 pi sqrt(k/m)) with the largest k/m of k = E L over the lighter end of every beam, and
/// of E L / m of every voxel without beams. @cite hiller2014dynamic
double recommended_time_step_s(const Lattice& lattice, double cell_edge_m, const Physics& physics);

}  // namespace menger::voxel
