// What the coupling does: forces of an energy, the contraction that it promises, and a step that stays stable.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "meshes/design/reference_shapes.h"
#include "voxel/engine/rest_lengths.h"
#include "voxel/engine/time_step.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

meshes::Polycube block(int nx, int ny, int nz) {
  return meshes::Polycube::from_digits(nx, ny, nz, std::string(static_cast<std::size_t>(nx * ny * nz), '1'));
}

Physics floating(double coupling) {
  Physics physics;
  physics.lateral_coupling = coupling;
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.actuation.mode = ActuationMode::none;
  physics.collisions.exclusion_depth.reset();
  physics.damping_ratios.global = 0.0;
  return physics;
}

/// The arrays that the coupling works on, with beams of unequal stiffness and voxels that are not in place.
struct Scattered {
  Scattered() : lattice(meshes::full_cube(3)) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto voxels = lattice.voxel_count();
    pose.assign(8 * voxels, 0.0);
    load.assign(8 * voxels, 0.0);
    data.pose = pose.data();
    data.load = load.data();
    for (std::size_t i = 0; i < voxels; ++i) {
      const meshes::CellIndex& cell = lattice.cells[i];
      pose[8 * i] = cell.x + 0.1 * uniform(random);
      pose[8 * i + 1] = cell.y + 0.1 * uniform(random);
      pose[8 * i + 2] = cell.z + 0.1 * uniform(random);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < lattice.beams[axis].lower.size(); ++i) {
        axial[axis].push_back(std::pow(10.0, uniform(random)));
        rest[axis].push_back(1.0 + 0.3 * uniform(random));
      }
      data.axis[axis].count = rest[axis].size();
      data.axis[axis].rest_length = rest[axis].data();
    }
  }
  double energy(LateralCoupling<double>& coupling) {
    coupling.add_loads(data);
    return coupling.energy_J();
  }

  Lattice lattice;
  std::array<std::vector<double>, 3> axial, rest;
  std::vector<double> pose, load;
  StepData<double> data;
};

TEST(LateralCoupling, ForcesAreTheNegativeGradientOfTheEnergy) {
  Scattered s;
  LateralCoupling<double> coupling(s.lattice, 0.7, s.axial);
  coupling.add_loads(s.data);
  const std::vector<double> force = s.load;
  // Central differences of a smooth energy of order one: h^2 and rounding / h are both below 1e-9.
  const double h = 1e-5;
  for (std::size_t i = 0; i < s.lattice.voxel_count(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double& x = s.pose[8 * i + axis];
      const double x0 = x;
      x = x0 + h;
      const double above = s.energy(coupling);
      x = x0 - h;
      const double below = s.energy(coupling);
      x = x0;
      EXPECT_NEAR(force[8 * i + axis], -(above - below) / (2.0 * h), 1e-8) << i << " " << axis;
    }
  }
}

TEST(LateralCoupling, RestLengthForcesAreTheNegativeDerivativeOfTheEnergy) {
  Scattered s;
  LateralCoupling<double> coupling(s.lattice, 0.7, s.axial);
  const double h = 1e-5;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < coupling.beam_count(axis); ++i) {
      coupling.add_loads(s.data);
      const double force = coupling.rest_length_force_N(axis, i);
      double& length = s.rest[axis][i];
      const double length0 = length;
      length = length0 + h;
      const double above = s.energy(coupling);
      length = length0 - h;
      const double below = s.energy(coupling);
      length = length0;
      EXPECT_NEAR(force, -(above - below) / (2.0 * h), 1e-8) << axis << " " << i;
    }
  }
}

TEST(LateralCoupling, ForcesHaveNoResultantAndNoMoment) {
  Scattered s;
  LateralCoupling<double>(s.lattice, 0.7, s.axial).add_loads(s.data);
  std::array<double, 3> force{}, moment{};
  double size = 0.0;
  for (std::size_t i = 0; i < s.lattice.voxel_count(); ++i) {
    const double* x = &s.pose[8 * i];
    const double* f = &s.load[8 * i];
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3;
      const std::size_t c = (a + 2) % 3;
      force[a] += f[a];
      moment[a] += x[b] * f[c] - x[c] * f[b];
      size += std::abs(f[a]);
    }
  }
  ASSERT_GT(size, 1.0);
  // A sum of 81 numbers, each rounded.
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(force[a], 0.0, 1e-14 * size);
    EXPECT_NEAR(moment[a], 0.0, 1e-13 * size);
  }
}

/// Transverse by axial strain in the middle of a wide bar under tension.
double contraction(double coupling, int width) {
  const int length = width + 4;
  const double edge = 0.01;
  Physics physics = floating(coupling);
  const meshes::Polycube bar = block(length, width, width);
  VoxelLoads loads;
  loads.force_N.assign(bar.count(), {0.0, 0.0, 0.0});
  const auto cells = bar.occupied();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double stress_force = 1e-3 * 1e4 * edge * edge;  // a strain of 1e-3
    if (cells[i].x == 0) loads.force_N[i][0] = -stress_force;
    if (cells[i].x == length - 1) loads.force_N[i][0] = stress_force;
  }
  // The slowest wave along the bar takes about 4 length sqrt(rho / E) and rings down under the damping of its ends.
  physics.damping_ratios.global = 0.1;
  Simulation simulation(bar, edge, physics, loads);
  EXPECT_EQ(simulation.advance_to(0.05), io::RunStatus::completed);
  const auto at = [&](int x, int y, int z) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] == meshes::CellIndex{x, y, z}) return simulation.position_m(i);
    }
    return std::array<double, 3>{};
  };
  const int xm = length / 2;
  const int m = width / 2;
  const double axial = (at(xm + 1, m, m)[0] - at(xm - 1, m, m)[0]) / (2.0 * edge) - 1.0;
  const double across = (at(xm, m + 1, m)[1] - at(xm, m - 1, m)[1]) / (2.0 * edge) - 1.0;
  EXPECT_GT(axial, 5e-4);
  return -across / axial;
}

TEST(LateralCoupling, ContractsTheInteriorOfAWideBarByCOverOnePlusC) {
  // Beams across the bar are coupled in full, those along its surface by half, so that a bar of n voxels contracts more, by a
  // share that falls as 1 / n: two widths give the limit, up to the terms of higher order.
  const double c = 0.5;
  const double narrow = contraction(c, 13);
  const double wide = contraction(c, 17);
  const double limit = (17.0 * wide - 13.0 * narrow) / (17.0 - 13.0);
  EXPECT_NEAR(limit, c / (1.0 + c), 0.015 * c / (1.0 + c));
  EXPECT_LT(wide, narrow);
  EXPECT_NEAR(wide, c / (1.0 + c), 0.05 * c / (1.0 + c));
  // Without coupling what is left is the second order of the strain.
  EXPECT_NEAR(contraction(0.0, 5), 0.0, 1e-3);
}

TEST(LateralCoupling, ShortensTheStepByTheRootOfItsStiffening) {
  const double plain = recommended_time_step_s(meshes::full_cube(3), 0.01, floating(0.0));
  EXPECT_DOUBLE_EQ(recommended_time_step_s(meshes::full_cube(3), 0.01, floating(0.5)), plain / std::sqrt(2.0));
  EXPECT_GT(recommended_time_step_s(meshes::full_cube(3), 0.01, floating(0.999)), plain / std::sqrt(3.0));
}

/// A cube in wild but small motion.
VoxelLoads shaken(const meshes::Polycube& body) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1e-3, 1e-3);
  VoxelLoads loads;
  for (std::size_t i = 0; i < body.count(); ++i)
    loads.initial_velocity_m_s.push_back({uniform(random), uniform(random), uniform(random)});
  return loads;
}

TEST(LateralCoupling, StaysStableNearPoissonsRatioOneHalf) {
  Physics physics = floating(0.999);
  physics.damping_ratios.bond = 0.0;
  physics.integration.time_step_fraction = 1.0;
  Simulation simulation(meshes::full_cube(4), 0.01, physics, shaken(meshes::full_cube(4)), {.energy_ledger = true});
  ASSERT_EQ(simulation.advance(20000), io::RunStatus::completed);
  const EnergyLedger& energy = *simulation.energy();
  // Nothing takes energy away, so an unstable mode would have grown without bound. A symplectic step at a third of its limit
  // keeps the energy within about (omega h / 2)^2 of the truth.
  EXPECT_NEAR((energy.kinetic_J + energy.elastic_J) / energy.kinetic_start_J, 1.0, 0.1);
}

TEST(LateralCoupling, StaysStableUnderCriticalDamping) {
  for (const DampingMode mode : {DampingMode::increments, DampingMode::velocity}) {
    Physics physics = floating(0.999);
    physics.integration.damping = mode;
    physics.integration.time_step_fraction = 0.9;
    const meshes::Polycube body = meshes::full_cube(5);
    Simulation simulation(body, 0.01, physics, shaken(body), {.energy_ledger = true});
    ASSERT_EQ(simulation.advance(4000), io::RunStatus::completed);
    const EnergyLedger& energy = *simulation.energy();
    // Free bodies keep their momentum, all else is damped away.
    EXPECT_LT(energy.elastic_J, 1e-6 * energy.kinetic_start_J);
  }
}

TEST(LateralCoupling, ConservesMomentumAndItsEnergyCloses) {
  for (const DampingMode mode : {DampingMode::increments, DampingMode::velocity}) {
    Physics physics = floating(0.8);
    physics.damping_ratios.bond = 0.1;
    physics.integration.damping = mode;
    const meshes::Polycube body = meshes::full_cube(3);
    const VoxelLoads loads = shaken(body);
    std::array<double, 3> mean{};
    for (const auto& v : loads.initial_velocity_m_s) {
      for (std::size_t a = 0; a < 3; ++a) mean[a] += v[a] / 27.0;
    }
    Simulation simulation(body, 0.01, physics, loads, {.energy_ledger = true});
    const std::array<double, 3> start = simulation.centre_of_mass_m();
    ASSERT_EQ(simulation.advance(5000), io::RunStatus::completed);
    for (std::size_t a = 0; a < 3; ++a) {
      const double moved = simulation.centre_of_mass_m()[a] - start[a];
      EXPECT_NEAR(moved, mean[a] * simulation.time_s(), 1e-9 * simulation.time_s()) << a;
    }
    const EnergyLedger& energy = *simulation.energy();
    EXPECT_LE(std::abs(energy.residual_J()), 1e-4 * energy.kinetic_start_J);
    EXPECT_LT(energy.bond_damping_work_J, -0.5 * energy.kinetic_start_J);
  }
}

TEST(LateralCoupling, BooksTheWorkOfTheDrive) {
  Physics physics = floating(0.6);
  physics.actuation.mode = ActuationMode::in_phase;
  physics.actuation.amplitude = 0.1;
  physics.damping_ratios.bond = 0.3;
  Simulation simulation(meshes::full_cube(3), 0.01, physics, {}, {.energy_ledger = true});
  ASSERT_EQ(simulation.advance_to(1.0), io::RunStatus::completed);
  const EnergyLedger& energy = *simulation.energy();
  EXPECT_GT(energy.actuation_work_J, 0.0);
  EXPECT_LT(std::abs(energy.residual_J()), 1e-3 * energy.actuation_work_J);
}

}  // namespace
}  // namespace menger::voxel
