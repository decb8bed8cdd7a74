#include <gtest/gtest.h>

#include <cmath>

#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

Physics ringing() {
  Physics physics;
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.actuation.mode = ActuationMode::none;
  physics.collisions.exclusion_depth.reset();
  physics.damping_ratios.global = 0.0;
  return physics;
}

VoxelLoads stretched_pair() {
  VoxelLoads loads;
  loads.initial_velocity_m_s = {{-0.01, 0.0, 0.0}, {0.01, 0.0, 0.0}};
  return loads;
}

TEST(EnergyLedger, ClosesOnAnUndampedRingDown) {
  Physics physics = ringing();
  physics.damping_ratios.bond = 0.0;
  Simulation simulation(meshes::bar(2), 0.01, physics, stretched_pair(), {.energy_ledger = true});
  ASSERT_EQ(simulation.advance(20000), io::RunStatus::completed);
  const EnergyLedger& energy = *simulation.energy();
  EXPECT_NEAR(energy.kinetic_start_J, 1e-5 * 1e-4, 1e-8 * 1e-9);
  EXPECT_LE(std::abs(energy.residual_J()), 1e-9 * energy.largest_energy_J);
  EXPECT_NEAR(energy.kinetic_J + energy.elastic_J, energy.kinetic_start_J, 1e-9 * energy.kinetic_start_J);
}

TEST(EnergyLedger, HasAScaleWhereverSomethingMoves) {
  // A voxel that is set down on the floor: neither springs nor, where damping stops it at once, kinetic energy worth naming.
  Physics physics = ringing();
  physics.floor = true;
  physics.gravity_m_s2 = 9.81;
  physics.damping_ratios.collision = 1.0;
  Simulation falling(meshes::bar(1), 0.01, physics, {}, {.energy_ledger = true});
  ASSERT_EQ(falling.advance(5000), io::RunStatus::completed);
  EXPECT_GE(falling.energy()->largest_energy_J, std::abs(falling.energy()->gravitational_J));
  EXPECT_GT(falling.energy()->largest_energy_J, 0.0);
  EXPECT_LE(std::abs(falling.energy()->residual_share()), 1e-9);

  Simulation resting(meshes::bar(1), 0.01, ringing(), {}, {.energy_ledger = true});
  ASSERT_EQ(resting.advance(10), io::RunStatus::completed);
  EXPECT_EQ(resting.energy()->largest_energy_J, 0.0);
  EXPECT_EQ(resting.energy()->residual_share(), 0.0);
}

TEST(EnergyLedger, ClosesOnADampedRingDown) {
  for (const DampingMode mode : {DampingMode::increments, DampingMode::velocity}) {
    Physics physics = ringing();
    physics.damping_ratios.bond = 0.1;
    physics.damping_ratios.global = 0.01;
    physics.integration.damping = mode;
    Simulation simulation(meshes::bar(2), 0.01, physics, stretched_pair(), {.energy_ledger = true});
    ASSERT_EQ(simulation.advance(2000), io::RunStatus::completed);
    const EnergyLedger& energy = *simulation.energy();
    EXPECT_LE(std::abs(energy.residual_J()), 1e-9 * energy.largest_energy_J);
    // The damping has taken it all, and only the damping.
    EXPECT_NEAR((energy.bond_damping_work_J + energy.global_damping_work_J) / -energy.kinetic_start_J, 1.0, 1e-6);
    EXPECT_LT(energy.bond_damping_work_J, energy.global_damping_work_J);
  }
}

TEST(EnergyLedger, ClosesOnBendingAndTorsion) {
  for (const std::size_t axis : {std::size_t{0}, std::size_t{2}}) {
    Physics physics = ringing();
    physics.damping_ratios.bond = 0.0;
    VoxelLoads loads;
    loads.initial_angular_velocity_rad_s.assign(2, {0.0, 0.0, 0.0});
    loads.initial_angular_velocity_rad_s[0][axis] = -1e-3;
    loads.initial_angular_velocity_rad_s[1][axis] = 1e-3;
    Simulation simulation(meshes::bar(2), 0.01, physics, loads, {.energy_ledger = true});
    ASSERT_EQ(simulation.advance(20000), io::RunStatus::completed);
    EXPECT_LE(std::abs(simulation.energy()->residual_J()), 1e-9 * simulation.energy()->largest_energy_J) << axis;
  }
}

TEST(EnergyLedger, KnowsTheWorkOfGravityAndOfTheFloor) {
  Physics physics;
  physics.actuation.mode = ActuationMode::none;
  VoxelLoads loads;
  loads.initial_velocity_m_s = {{0.1, 0.0, 0.0}};
  Simulation simulation(meshes::bar(1), 0.01, physics, loads, {.energy_ledger = true});
  ASSERT_EQ(simulation.advance_to(0.2), io::RunStatus::completed);
  const EnergyLedger& energy = *simulation.energy();
  EXPECT_TRUE(simulation.is_in_static_friction(0));
  EXPECT_LT(energy.friction_work_J, 0.0);
  EXPECT_LE(std::abs(energy.residual_J()), 1e-9 * energy.kinetic_start_J);
}

TEST(EnergyLedger, LeavesTheTrajectoryAlone) {
  const meshes::Polycube body = meshes::fractal(meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211"), 2);
  Simulation plain(body, 0.01, Physics{});
  Simulation booked(body, 0.01, Physics{}, {}, {.energy_ledger = true});
  ASSERT_EQ(plain.advance(1000), io::RunStatus::completed);
  ASSERT_EQ(booked.advance(1000), io::RunStatus::completed);
  for (std::size_t i = 0; i < plain.voxel_count(); ++i) {
    const auto a = plain.position_m(i);
    const auto b = booked.position_m(i);
    ASSERT_EQ(a, b) << i;
  }
}

/// Ledger after five cycles of a walking sponge.
EnergyLedger gait(double amplitude, double time_step_fraction) {
  Physics physics;
  physics.actuation.amplitude = amplitude;
  physics.integration.time_step_fraction = time_step_fraction;
  Simulation simulation(meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211"), 0.01, physics, {},
                        {.energy_ledger = true});
  EXPECT_EQ(simulation.advance_to(1.0), io::RunStatus::completed);
  return *simulation.energy();
}

TEST(EnergyLedger, ClosesOnAGaitWithoutLargeAngles) {
  // Geometric nonlinearity, not time integration, leaves the rest.
  const EnergyLedger energy = gait(0.07, 0.9);
  EXPECT_GT(energy.actuation_work_J, 0.0);
  EXPECT_LT(energy.friction_work_J, 0.0);
  EXPECT_LT(std::abs(energy.residual_J()), 1e-3 * energy.actuation_work_J);
}

TEST(EnergyLedger, ShowsTheEnergyThatStateSwitchesOfBeamsMake) {
  // At the paper's amplitude beams pass between the small- and the large-angle state in every cycle. Their stored energy jumps
  // there without work: 18 % of what the drive gives, whatever the step, so it is the model's own and not an error of the
  // integration.
  const EnergyLedger coarse = gait(0.144714, 0.9);
  const EnergyLedger fine = gait(0.144714, 0.09);
  EXPECT_NEAR(coarse.residual_J() / coarse.actuation_work_J, 0.18, 0.01);
  EXPECT_NEAR(fine.residual_J() / fine.actuation_work_J, 0.18, 0.01);
}

}  // namespace
}  // namespace menger::voxel
