#pragma once

#include "meshes/design/polycube.h"
#include "voxel/engine/voxel_classes.h"
#include "voxel/laws/lattice.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Returns the mass of a solid voxel, rho L^3, kg.
double voxel_mass_kg(const VoxelMaterial& material, double cell_edge_m);

/// Returns the modulus of a beam between two materials, the harmonic mean 2 E1 E2 / (E1 + E2), Pa.
double beam_modulus_Pa(const VoxelMaterial& a, const VoxelMaterial& b);

/// Returns the recommended step of a lattice of solid voxels, s: 1 / (2 pi sqrt(k/m)). k/m is the largest value of
/// - E L over the mass of the lighter end of every beam,
/// - E L / m of every voxel without beams, and with a floor or collisions of every voxel, because a voxel touches with its own
///   modulus: a stiff foot on a soft body is stiffer than its beam.
///
/// With lateral coupling c the step is shorter by sqrt(1 + 2 c). Strong damping and two densities may need shorter steps:
/// - Where the damping of a beam is explicit, its E L counts max(1, zeta f)^2 times, with f of bond_rate_factor.
/// - With a floor or collisions the step is at most half of the largest stable one of a voxel on the floor, and of any two that
///   collide (largest_collision_step_s).
///
/// Where both materials have one modulus and density, and damping ratios are at most 1, only the beams count, or the voxel
/// without beams. @cite hiller2014dynamic
double recommended_time_step_s(const Lattice& lattice, double cell_edge_m, const Physics& physics);

/// Returns the recommended step for the classes of a calibrated body, s. k/m is then the largest of
/// - (1 + 2 c) EA / L and 12 EI / (L^3 (1 + Phi)) over the mass of the lighter end of every beam,
/// - (2 + Phi) EI / (L (1 + Phi)) and GJ / L over the smaller moment of inertia of the ends of every beam,
/// - half the ground's stiffness over the mass of every voxel.
///
/// For solid voxels all but the torsion are E L / m. Phi is that of the beam's shear, 0 if it does not shear; see
/// beam_coefficients. A damping ratio of the beams above 2 shortens the step of the beams in proportion. Where there is a floor
/// the step is at most half of the largest_standing_step_s.
double recommended_time_step_s(const Lattice& lattice, const BodyClasses& classes, double edge_m, const Physics& physics);

/// Returns the recommended step of a body, solid or calibrated, s.
/// @param cell_edge_m of a design's cell
double recommended_time_step_s(const meshes::Polycube& body, double cell_edge_m, const Physics& physics);

/// Returns the largest stable step, s, of a mass on a spring with a damper that acts with the velocity before the step:
/// k h^2 + 2 c h < 4.
/// @param stiffness_per_mass k, 1/s^2
/// @param damping_per_mass c, 1/s
double largest_contact_step_s(double stiffness_per_mass, double damping_per_mass);

/// Returns the largest stable step, s, of two free solid voxels that press on each other. A light voxel is damped by the mean of
/// both dampings (contact_force), which for a stiff and heavy partner is far more than its own.
double largest_collision_step_s(const VoxelMaterial& a, const VoxelMaterial& b, double cell_edge_m, const Physics& physics);

/// Returns by what the explicit damping of a beam between two materials shortens its step, >= 1, so that a step takes no more of
/// the fastest motion than beams of one density do at a ratio of 1.
double slower_by_damping(const Physics& physics, const VoxelMaterial& a, const VoxelMaterial& b);

/// Returns the largest stable step, s, of a voxel that stands on all feet of a wall (FootContact) and rocks on them without
/// sliding.
/// @param edge_m of the voxel
double largest_standing_step_s(const FloorCoefficients<double>& floor, double mass_kg, double inertia_kg_m2, double edge_m);

}  // namespace menger::voxel
