#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "meshes/design/polycube.h"
#include "tests/extremes/row.h"
#include "voxel/lanes/simulation.h"

namespace menger::extremes {

// The paper's voxel: edge 1 cm, 10 kPa, 10 kg/m^3.
inline constexpr double edge_m = 0.01;
inline constexpr double modulus_Pa = 1e4;
inline constexpr double mass_kg = 10.0 * edge_m * edge_m * edge_m;
inline constexpr double stiffness_N_per_m = modulus_Pa * edge_m;
inline constexpr double gravity_m_per_s2 = 9.80665;

/// Returns the physics of a body without a drive, on the floor, without collisions.
voxel::Physics still_physics();

/// Returns the same physics without floor, gravity and damping against the world.
voxel::Physics floating_physics();

/// Options with which a run computes its energy balance.
inline constexpr voxel::KernelOptions with_ledger{.energy_ledger = true};

/// Checks the error of the energy balance of a run, divided by its largest energy.
void expect_energy_error(Outcome& outcome, const voxel::Simulation& simulation, double bound);

/// Expects the status `completed`; otherwise the outcome says how the run diverged.
void expect_completed(Outcome& outcome, const voxel::Simulation& simulation, io::RunStatus status);

/// Returns a column of cells of two materials, listed from the bottom.
meshes::Polycube column(const std::vector<meshes::Material>& materials);

/// Returns an unsymmetric basal body of two materials.
meshes::Polycube walker();

/// Returns the lateral coupling c for a Poisson's ratio: nu = c / (1 + c) in a wide body.
double coupling_of(double poissons_ratio);

/// Returns the stress divided by the strain of a wide bar that is free to contract, and by the modulus E of its beams: (1 - c)(1
/// + 2 c) / (1 + c). This is the continuum with lambda = c E and lambda + 2 mu = E.
double wide_bar_stiffness(double coupling);

/// Returns the value extrapolated from bars of three widths, each twice the one before. The errors in 1/width and its square are
/// removed.
double extrapolated(double narrow, double middle, double wide);

std::vector<Row> voxel_contrast_rows();
std::vector<Row> voxel_drive_rows();
std::vector<Row> voxel_step_rows();
std::vector<Row> voxel_floor_rows();
std::vector<Row> voxel_body_rows();
std::vector<Row> voxel_coupling_rows();
std::vector<Row> voxel_solid_bar_rows();

}  // namespace menger::extremes
