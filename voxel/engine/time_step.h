#pragma once

#include "meshes/design/polycube.h"
#include "voxel/engine/voxel_classes.h"
#include "voxel/laws/lattice.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Mass of a voxel, rho L^3, kg.
double voxel_mass_kg(const VoxelMaterial& material, double cell_edge_m);

/// Modulus of a beam between two materials, the harmonic mean 2 E1 E2 / (E1 + E2), Pa.
double beam_modulus_Pa(const VoxelMaterial& a, const VoxelMaterial& b);

/// Recommended step of a lattice, s: 1 / (2 pi sqrt(k/m)) with the largest k/m of k = E L over the lighter end of every beam, and
/// of E L / m of every voxel without beams; with lateral coupling c shorter by sqrt(1 + 2 c). For bodies of solid voxels. @cite
/// hiller2014dynamic
double recommended_time_step_s(const Lattice& lattice, double cell_edge_m, const Physics& physics);

/// The same for the classes of a calibrated body: k/m is the largest of (1 + 2 c) EA / L and 12 EI / (L^3 (1 + Phi)) over the
/// lighter end, (2 + Phi) EI / (L (1 + Phi)) and GJ / L over the smaller moment of inertia of every beam, and half the ground's
/// stiffness over the mass of every voxel; of solid voxels all but the torsion are E L / m. Phi is that of the beam's shear, 0 if
/// it does not shear; see beam_coefficients. Where there is a floor the step is at most half of the largest_standing_step_s.
double recommended_time_step_s(const Lattice& lattice, const BodyClasses& classes, double edge_m, const Physics& physics);

/// The same of a body, solid or calibrated. @param cell_edge_m of a design's cell
double recommended_time_step_s(const meshes::Polycube& body, double cell_edge_m, const Physics& physics);

/// Largest stable step, s, of a voxel that stands on all feet of a wall (FootContact) and rocks on them without sliding.
/// @param edge_m of the voxel
double largest_standing_step_s(const FloorCoefficients<double>& floor, double mass_kg, double inertia_kg_m2, double edge_m);

}  // namespace menger::voxel
