// The same bytes from every instruction set, with every term kept in the loop, and from every thread.

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

meshes::Polycube walker() { return meshes::fractal(meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211"), 2); }

/// Positions and orientations of all voxels after `steps` steps, voxel by voxel.
std::vector<double> state_after(const meshes::Polycube& body, const Physics& physics, KernelOptions options,
                                std::uint64_t steps = 2000, const VoxelLoads& loads = {}) {
  options.blocks_in_lanes = false;  // which have kernels of their own
  Simulation simulation(body, 0.01, physics, loads, options);
  EXPECT_EQ(simulation.advance(steps), io::RunStatus::completed);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < simulation.voxel_count(); ++i) {
    for (const double value : simulation.position_m(i)) numbers.push_back(value);
    for (const double value : simulation.orientation(i)) numbers.push_back(value);
    for (const double value : simulation.velocity_m_s(i)) numbers.push_back(value);
    for (const double value : simulation.angular_velocity_rad_s(i)) numbers.push_back(value);
  }
  return numbers;
}

bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

std::optional<std::vector<double>> state_if_available(const meshes::Polycube& body, const Physics& physics, InstructionSet set) {
  try {
    return state_after(body, physics, {.instruction_set = set});
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

void expect_same_bytes_from_all_instruction_sets(const meshes::Polycube& body, const Physics& physics) {
  const std::vector<double> scalar = state_after(body, physics, {.instruction_set = InstructionSet::scalar});
  for (const InstructionSet set : {InstructionSet::best, InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
    const auto packed = state_if_available(body, physics, set);
    if (packed) {
      EXPECT_TRUE(same_bytes(scalar, *packed)) << static_cast<int>(set);
    }
  }
}

TEST(Kernels, OfAllInstructionSetsGiveTheSameBytes) {
  Physics physics;
  expect_same_bytes_from_all_instruction_sets(walker(), physics);
  physics.integration.damping = DampingMode::velocity;
  expect_same_bytes_from_all_instruction_sets(walker(), physics);
  physics.integration.number = NumberType::float32;
  expect_same_bytes_from_all_instruction_sets(walker(), physics);
}

TEST(Kernels, OfAllInstructionSetsGiveTheSameBytesForTwoMaterials) {
  Physics physics;
  physics.materials[1].youngs_modulus_Pa = 2e4;
  physics.materials[1].density_kg_m3 = 15.0;
  physics.materials[1].kinetic_friction = 0.3;
  expect_same_bytes_from_all_instruction_sets(walker(), physics);
  physics.integration.damping = DampingMode::velocity;
  expect_same_bytes_from_all_instruction_sets(walker(), physics);
}

TEST(Kernels, GiveTheSameBytesWithEveryTermKeptInTheLoop) {
  std::vector<Physics> scenes(5);
  scenes[1].floor = false;
  scenes[2].gravity_m_s2 = 0.0;
  scenes[3].actuation.mode = ActuationMode::none;
  scenes[4].collisions.exclusion_depth = 100;  // every pair is within it
  for (Physics& physics : scenes) {
    for (const DampingMode mode : {DampingMode::increments, DampingMode::velocity}) {
      physics.integration.damping = mode;
      const std::vector<double> lean = state_after(walker(), physics, {}, 500);
      const std::vector<double> full = state_after(walker(), physics, {.every_term = true}, 500);
      EXPECT_TRUE(same_bytes(lean, full)) << &physics - scenes.data();
    }
  }
}

TEST(Kernels, GiveTheSameBytesWithAnySingleTermKeptInTheLoop) {
  Physics physics;
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.actuation.mode = ActuationMode::none;
  VoxelLoads loads;
  loads.initial_velocity_m_s.assign(walker().count(), {0.0, 0.0, 0.0});
  loads.initial_velocity_m_s[3] = {0.01, -0.02, 0.03};  // all that moves it
  const std::vector<double> lean = state_after(walker(), physics, {}, 500, loads);
  const std::vector<KeptTerms> single{
      {.coefficients = true}, {.floor = true}, {.gravity = true}, {.actuation = true}, {.collisions = true}};
  for (const KeptTerms& kept : single)
    EXPECT_TRUE(same_bytes(lean, state_after(walker(), physics, {.kept = kept}, 500, loads))) << &kept - single.data();
}

TEST(Kernels, KeepCollisionWorkOnRequest) {
  // A full cube at rest: no pair can touch, so that pairs are looked at only where that is asked for.
  Physics physics;
  physics.actuation.mode = ActuationMode::none;
  Simulation lean(meshes::full_cube(3), 0.01, physics);
  Simulation kept(meshes::full_cube(3), 0.01, physics, {}, {.kept = {.collisions = true}});
  ASSERT_EQ(lean.advance(100), io::RunStatus::completed);
  ASSERT_EQ(kept.advance(100), io::RunStatus::completed);
  EXPECT_EQ(lean.collision_counts().steps_with_pairs, 0U);
  EXPECT_EQ(kept.collision_counts().steps_with_pairs, 100U);
  EXPECT_EQ(kept.collision_counts().list_rebuilds, lean.collision_counts().list_rebuilds) << "the list is still kept";
}

TEST(Kernels, GiveTheSameBytesForMixedFixedAndLoadedVoxels) {
  const meshes::Polycube body = walker();
  VoxelLoads loads;
  loads.fixed.assign(body.count(), false);
  loads.fixed[5] = true;
  loads.size_factor.assign(body.count(), 1.0);
  loads.size_factor[7] = 1.05;
  loads.force_N.assign(body.count(), {0.0, 0.0, 0.0});
  loads.force_N[100] = {1e-4, -1e-4, 2e-4};
  loads.moment_N_m.assign(body.count(), {0.0, 0.0, 0.0});
  loads.moment_N_m[200] = {1e-7, 0.0, -1e-7};
  for (const NumberType number : {NumberType::float64, NumberType::float32}) {
    Physics physics;
    physics.materials[1].youngs_modulus_Pa = 2e4;
    physics.materials[1].density_kg_m3 = 15.0;
    physics.integration.number = number;
    physics.integration.damping = DampingMode::velocity;
    const std::vector<double> best = state_after(body, physics, {}, 500, loads);
    EXPECT_TRUE(same_bytes(best, state_after(body, physics, {.instruction_set = InstructionSet::scalar}, 500, loads)));
    EXPECT_TRUE(same_bytes(best, state_after(body, physics, {.every_term = true}, 500, loads)));
  }
}

TEST(Kernels, SayWhatTheyLeaveOut) {
  Physics physics;
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.actuation.mode = ActuationMode::none;
  physics.collisions.exclusion_depth = 2;
  std::string report;
  for (const std::string& line : Simulation(meshes::bar(3), 0.01, physics).kernel_report()) report += line + "\n";
  for (const char* term : {"floor left out", "gravity left out", "actuation left out", "collisions left out: every pair"}) {
    EXPECT_NE(report.find(term), std::string::npos) << report;
  }
}

TEST(Kernels, SayWhyVoxelsShareTheirCoefficients) {
  const auto report = [](const meshes::Polycube& body, const Physics& physics) {
    std::string text;
    for (const std::string& line : Simulation(body, 0.01, physics).kernel_report()) text += line + "\n";
    return text;
  };
  Physics physics;
  meshes::Polycube body = meshes::bar(3);
  EXPECT_NE(report(body, physics).find("left out: all voxels are of one material and free"), std::string::npos);
  body.set({0, 0, 0}, 2);
  const std::string equal = report(body, physics);
  EXPECT_NE(equal.find("both materials have the same properties: they differ in phase alone"), std::string::npos) << equal;
  EXPECT_EQ(equal.find("of one material"), std::string::npos) << equal;
  physics.materials[1].youngs_modulus_Pa *= 2.0;
  EXPECT_EQ(report(body, physics).find("coefficients per voxel and beam left out"), std::string::npos);
}

TEST(Kernels, SkipCollisionWorkWhileContactIsRuledOut) {
  // Two bars 5 edges apart that hardly move: nothing to do, and the bytes are those of a run that looks at every pair in every
  // step.
  meshes::Polycube body(3, 6, 1);
  for (int x = 0; x < 3; ++x) {
    body.set({x, 0, 0}, 1);
    body.set({x, 5, 0}, 2);
  }
  Physics physics;
  physics.collisions.exclusion_depth = 2;  // leaves out the ends of a bar, which come near each other
  Simulation simulation(body, 0.01, physics);
  ASSERT_EQ(simulation.advance(3000), io::RunStatus::completed);
  EXPECT_EQ(simulation.collision_counts().steps_with_pairs, 0U);
  EXPECT_EQ(simulation.collision_counts().steps_skipped, 3000U);
  EXPECT_LT(simulation.collision_counts().list_rebuilds, 20U);
  EXPECT_TRUE(same_bytes(state_after(body, physics, {}, 3000), state_after(body, physics, {.every_term = true}, 3000)));
}

TEST(Kernels, GiveTheSameBytesInEveryThread) {
  const Physics physics;
  const std::vector<double> here = state_after(walker(), physics, {}, 500);
  std::vector<std::vector<double>> there(3);
  std::vector<std::thread> threads;
  threads.reserve(there.size());
  for (std::vector<double>& result : there) {
    threads.emplace_back([&result, &physics] { result = state_after(walker(), physics, {}, 500); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& result : there) EXPECT_TRUE(same_bytes(here, result));
}

TEST(Float, FollowsDoubleThroughALongGait) {
  // Damping from velocities, 25 cycles of the paper's step. Float keeps positions by a compensated sum and quaternions at unit
  // length; without the latter the robot is 3 mm elsewhere.
  Physics physics;
  physics.integration.damping = DampingMode::velocity;
  physics.collisions.exclusion_depth.reset();
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211");
  const auto simulate = [&](NumberType number) {
    physics.integration.number = number;
    Simulation simulation(body, 0.01, physics);
    EXPECT_EQ(simulation.advance_to(5.0), io::RunStatus::completed);
    return simulation;
  };
  const auto exact = simulate(NumberType::float64).centre_of_mass_m();
  const Simulation rounded = simulate(NumberType::float32);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(rounded.centre_of_mass_m()[axis], exact[axis], 1e-4);
  for (std::size_t i = 0; i < rounded.voxel_count(); ++i) {
    const auto q = rounded.orientation(i);
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 2e-6);
  }
}

/// Of a walk of a second from a place, m.
std::array<double, 3> walk_m(NumberType number, const std::array<double, 3>& from_m) {
  Physics physics;
  physics.integration.damping = DampingMode::velocity;
  physics.integration.number = number;
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211");
  VoxelLoads loads;
  loads.initial_displacement_m.assign(body.count(), from_m);
  Simulation simulation(body, 0.01, physics, loads);
  const auto start = simulation.centre_of_mass_m();
  EXPECT_EQ(simulation.advance_to(1.0), io::RunStatus::completed);
  const auto end = simulation.centre_of_mass_m();
  return {end[0] - start[0], end[1] - start[1], end[2] - start[2]};
}

TEST(Float, WalksAKilometreAwayAsItDoesAtTheOrigin) {
  // Where it stands changes the start by the rounding of a kilometre in double, 1e-13 m. That turns some roundings of single
  // precision, of 2e-9 m, which friction, the only switch, amplifies to 2e-3 of the walk; counted from the world's origin
  // positions would be rounded to 1e-6 m at 10 m, which makes 0.1 of the walk.
  const auto here = walk_m(NumberType::float32, {0.0, 0.0, 0.0});
  const double walked = std::hypot(here[0], here[1]);
  ASSERT_GT(walked, 0.002);
  for (const double away : {10.0, 1000.0}) {
    const auto there = walk_m(NumberType::float32, {away, -away, 0.0});
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(there[axis], here[axis], 1e-2 * walked) << away;
  }
}

TEST(Float, KeepsItsShapeOnALongFlight) {
  // By Galilei a bar that flies rings like one that stays. Momenta of 1 m/s in single precision make noise of the strain;
  // positions counted from the world's origin would add a rounding of 8e-4.
  const auto strains = [](double from_m, double speed_m_s) {
    Physics physics;
    physics.integration = {.damping = DampingMode::velocity, .number = NumberType::float32};
    physics.floor = false;
    physics.gravity_m_s2 = 0.0;
    physics.damping_ratios.global = 0.0;
    physics.damping_ratios.bond = 0.0;
    physics.actuation.mode = ActuationMode::none;
    VoxelLoads loads;
    loads.initial_displacement_m.assign(3, {from_m, 0.0, 0.0});
    loads.initial_velocity_m_s = {{speed_m_s - 0.1, 0.0, 0.0}, {speed_m_s, 0.0, 0.0}, {speed_m_s + 0.1, 0.0, 0.0}};
    Simulation simulation(meshes::bar(3), 0.01, physics, loads);
    EXPECT_EQ(simulation.advance_to(1.0), io::RunStatus::completed);
    EXPECT_NEAR(simulation.centre_of_mass_m()[0], from_m + 0.01 + speed_m_s * simulation.time_s(), 1e-5);
    return simulation.frame().strain;
  };
  const std::vector<double> at_rest = strains(0.0, 0.0);
  const std::vector<double> flying = strains(100.0, 1.0);
  ASSERT_GT(std::abs(at_rest[0]), 1e-3);
  for (std::size_t i = 0; i < at_rest.size(); ++i) EXPECT_NEAR(flying[i], at_rest[i], 5e-5);
}

TEST(Simulation, StopsAtTheFirstStepAtOrAfterATime) {
  Simulation simulation(meshes::bar(2), 0.01, Physics{});
  for (int i = 0; i < 2000; ++i) {
    ASSERT_EQ(simulation.advance(1), io::RunStatus::completed);
    const std::uint64_t steps = simulation.steps();
    ASSERT_EQ(simulation.advance_to(simulation.time_s()), io::RunStatus::completed);
    ASSERT_EQ(simulation.steps(), steps);
  }
}

TEST(Simulation, RefusesParametersOutOfRange) {
  const auto refuses = [](auto change) {
    Physics physics;
    change(physics);
    EXPECT_THROW(Simulation(meshes::bar(2), 0.01, physics), std::invalid_argument);
  };
  refuses([](Physics& p) { p.materials[0].youngs_modulus_Pa = -1.0; });
  refuses([](Physics& p) { p.materials[1].density_kg_m3 = 0.0; });
  refuses([](Physics& p) { p.actuation.amplitude = 1.0; });
  refuses([](Physics& p) { p.integration.time_step_fraction = 0.0; });
  refuses([](Physics& p) { p.collisions.exclusion_depth = 0; });
  refuses([](Physics& p) { p.integration.number = NumberType::float32; });  // with damping from increments
  // Within their own range, but not together.
  refuses([](Physics& p) { p.materials[0].youngs_modulus_Pa = p.materials[1].youngs_modulus_Pa = 1e200; });
  refuses([](Physics& p) { p.materials[0].density_kg_m3 = 1e-320; });
  refuses([](Physics& p) { p.integration.time_step_fraction = 1e-320; });
  EXPECT_THROW(Simulation(meshes::Polycube(2, 2, 2), 0.01, Physics{}), std::invalid_argument);
  EXPECT_THROW(Simulation(meshes::bar(2), 0.0, Physics{}), std::invalid_argument);
  EXPECT_THROW(Simulation(meshes::bar(2), 1e120, Physics{}), std::invalid_argument);
  EXPECT_THROW(Simulation(meshes::bar(2), 1e-120, Physics{}), std::invalid_argument);
  VoxelLoads loads;
  loads.initial_displacement_m = {{0.0, 0.0, 0.0}, {std::numeric_limits<double>::infinity(), 0.0, 0.0}};
  EXPECT_THROW(Simulation(meshes::bar(2), 0.01, Physics{}, loads), std::invalid_argument);
}

}  // namespace
}  // namespace menger::voxel
