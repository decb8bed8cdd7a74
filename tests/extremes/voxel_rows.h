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

/// A body that nothing drives, on the floor, without collisions.
voxel::Physics still_physics();

/// The same without floor, gravity and damping against the world.
voxel::Physics floating_physics();

/// Keeps the energy balance.
inline constexpr voxel::KernelOptions with_ledger{.energy_ledger = true};

/// Hands in the energy that the books of a run do not explain, by its largest energy.
void expect_energy_error(Outcome& outcome, const voxel::Simulation& simulation, double bound);

/// `completed`, or how it diverged.
void expect_completed(Outcome& outcome, const voxel::Simulation& simulation, io::RunStatus status);

/// A column of cells of two materials, from the bottom.
meshes::Polycube column(const std::vector<meshes::Material>& materials);

/// A basal body of two materials, lopsided.
meshes::Polycube walker();

/// Lateral coupling c of a Poisson's ratio: nu = c / (1 + c) in a wide body.
double coupling_of(double poissons_ratio);

/// Stress by strain of a wide bar free to contract, by the modulus E of its beams: the continuum with lambda = c E and
/// lambda + 2 mu = E, (1 - c)(1 + 2 c) / (1 + c).
double wide_bar_stiffness(double coupling);

/// What bars of three widths, each twice the one before, have without their errors in 1/width and its square.
double extrapolated(double narrow, double middle, double wide);

std::vector<Row> voxel_contrast_rows();
std::vector<Row> voxel_drive_rows();
std::vector<Row> voxel_step_rows();
std::vector<Row> voxel_floor_rows();
std::vector<Row> voxel_body_rows();
std::vector<Row> voxel_coupling_rows();
std::vector<Row> voxel_solid_bar_rows();

}  // namespace menger::extremes
