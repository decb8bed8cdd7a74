// Robots that blocks of threads step come to the bytes of the engine, with a lone thread in place of a block; and a graphics
// processor comes to them but for rounding.

#include "voxel/device/device_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "io/device/graphics_processor.h"
#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/surrogate_example.h"
#include "tests/unit/voxel/lanes/robot_numbers.h"
#include "voxel/device/robot_runner.h"

namespace menger::voxel {
namespace {

std::vector<Simulation> simulations_of(const std::vector<meshes::Polycube>& bodies, const Physics& physics) {
  std::vector<Simulation> simulations;
  for (const meshes::Polycube& body : bodies) simulations.emplace_back(body, 0.01, physics);
  return simulations;
}

std::vector<meshes::Polycube> random_bodies(std::size_t count, const std::string& shape = std::string(27, '?')) {
  std::mt19937 generator(5);
  std::vector<meshes::Polycube> bodies;
  while (bodies.size() < count) {
    std::string digits = shape;
    for (char& digit : digits) {
      if (digit == '?') digit = static_cast<char>('0' + generator() % 3);
      if (digit == 'm') digit = static_cast<char>('1' + generator() % 2);
    }
    bodies.push_back(meshes::Polycube::from_digits(3, 3, 3, digits));
  }
  return bodies;
}

const std::string sponge = "mmmm0mmmmm0m000m0mmmmm0mmmm";

Physics physics_of(NumberType number, DampingMode damping) {
  Physics physics;
  physics.integration.number = number;
  physics.integration.damping = damping;
  return physics;
}

std::vector<Physics> modes() {
  return {physics_of(NumberType::float64, DampingMode::increments), physics_of(NumberType::float64, DampingMode::velocity),
          physics_of(NumberType::float32, DampingMode::velocity)};
}

std::string divergence_of(const Simulation& one) { return one.divergence() ? divergence_text(*one.divergence()) : ""; }

/// Advances robots on the device in two goes, and one after the other on the processor, and compares.
/// @param make returns equal simulations every time
/// @param same (robot on the device, robot on the processor) compares them
template <class Make, class Same>
void expect_same(const Make& make, double time_s, Stepper stepper, const Same& same, std::size_t on_processor = 0) {
  std::vector<Simulation> alone = make();
  std::vector<io::RunStatus> expected;
  for (Simulation& simulation : alone) expected.push_back(simulation.advance_to(time_s));
  std::vector<Simulation> robots = make();
  static_cast<void>(advance_on_device_to(robots, 0.4 * time_s, nullptr, stepper));
  const DeviceAdvance advance = advance_on_device_to(robots, time_s, nullptr, stepper);
  EXPECT_EQ(advance.statuses, expected);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(advance.on_processor, true)), on_processor);
  for (std::size_t i = 0; i < alone.size(); ++i) same(robots[i], alone[i]);
}

template <class Make>
void expect_same_bytes(const Make& make, double time_s, std::size_t on_processor = 0) {
  expect_same(
      make, time_s, Stepper::lone_thread,
      [](const Simulation& robot, const Simulation& alone) {
        EXPECT_TRUE(same_bytes(numbers_of(robot), numbers_of(alone)));
        EXPECT_EQ(divergence_of(robot), divergence_of(alone));
      },
      on_processor);
}

void expect_same_bytes(const std::vector<meshes::Polycube>& bodies, const Physics& physics, double time_s) {
  expect_same_bytes([&] { return simulations_of(bodies, physics); }, time_s);
}

TEST(DeviceSteps, GiveTheBytesOfTheEngine) {
  for (const Physics& physics : modes()) {
    expect_same_bytes(random_bodies(7, sponge), physics, 0.03);
    expect_same_bytes(random_bodies(9), physics, 0.03);
  }
}

TEST(DeviceSteps, GiveTheBytesOfTheEngineForTwoMaterials) {
  for (Physics physics : modes()) {
    physics.materials[1].youngs_modulus_Pa = 2e4;
    physics.materials[1].density_kg_m3 = 15.0;
    physics.materials[1].kinetic_friction = 0.3;
    expect_same_bytes(random_bodies(5), physics, 0.03);
  }
}

TEST(DeviceSteps, GiveTheBytesOfTheEngineForAggregates) {
  std::vector<meshes::Polycube> bodies;
  for (const meshes::Polycube& body : random_bodies(2, sponge)) bodies.push_back(meshes::fractal(body, 2));
  for (Physics physics : modes()) {
    expect_same_bytes(bodies, physics, 0.012);
    physics.collisions.exclusion_depth = 5;
    expect_same_bytes(bodies, physics, 0.006);
  }
}

TEST(DeviceSteps, GiveTheBytesOfTheEngineWithoutFloorGravityDriveAndCollisions) {
  for (Physics physics : modes()) {
    Physics floating = physics;
    floating.floor = false;
    expect_same_bytes(random_bodies(3), floating, 0.02);
    physics.gravity_m_s2 = 0.0;
    physics.actuation.mode = ActuationMode::none;
    physics.collisions.exclusion_depth.reset();
    expect_same_bytes(random_bodies(3), physics, 0.02);
  }
}

TEST(DeviceSteps, GiveTheBytesOfTheEngineForOtherDrivesAndStops) {
  for (Physics physics : modes()) {
    physics.actuation.mode = ActuationMode::wave;
    physics.actuation.ramp_s = 0.02;
    physics.stop_rotation_in_static_friction = true;
    physics.integration.single_precision_rest_lengths = true;
    expect_same_bytes(random_bodies(3), physics, 0.03);
    physics.actuation.mode = ActuationMode::hold;
    physics.beam_moments = BeamMoments::balanced;
    expect_same_bytes(random_bodies(3), physics, 0.03);
  }
}

TEST(DeviceSteps, GiveTheBytesOfTheEngineForLoads) {
  for (const Physics& physics : modes()) {
    const meshes::Polycube body = random_bodies(1).front();
    VoxelLoads loads;
    loads.force_N.assign(body.count(), {1e-5, 2e-5, 0.0});
    loads.moment_N_m.assign(body.count(), {0.0, 1e-8, 0.0});
    loads.initial_velocity_m_s.assign(body.count(), {0.1, 0.0, 0.2});
    loads.fixed.assign(body.count(), false);
    loads.fixed.front() = true;
    expect_same_bytes(
        [&] {
          std::vector<Simulation> simulations;
          simulations.emplace_back(body, 0.01, physics, loads);
          return simulations;
        },
        0.02);
  }
}

/// Two parts of a body without a beam between them fly towards each other.
void expect_same_bytes_of_collision(int length, int width) {
  const int gap = 3;
  meshes::Polycube body(2 * length + gap, width, width);
  for (int x = 0; x < 2 * length + gap; ++x) {
    if (x >= length && x < length + gap) continue;
    for (int y = 0; y < width; ++y) {
      for (int z = 0; z < width; ++z) body.set({x, y, z}, 1);
    }
  }
  for (Physics physics : modes()) {
    physics.gravity_m_s2 = 0.0;
    physics.floor = false;
    VoxelLoads loads;
    for (const meshes::CellIndex& cell : body.occupied())
      loads.initial_velocity_m_s.push_back({cell.x <= length ? 0.5 : -0.5, 0.0, 0.0});
    const auto parts = [&] {
      std::vector<Simulation> simulations;
      simulations.emplace_back(body, 0.01, physics, loads);
      return simulations;
    };
    std::vector<Simulation> engine = parts();
    ASSERT_EQ(engine.front().advance_to(0.06), io::RunStatus::completed);
    const auto last_in_row = static_cast<std::size_t>(length - 1);  // of the first part
    EXPECT_LT(engine.front().velocity_m_s(last_in_row)[0], 0.3);    // they have met
    expect_same_bytes(parts, 0.06);
  }
}

TEST(DeviceSteps, FindContactsBetweenPartsThatComeTogether) { expect_same_bytes_of_collision(3, 2); }

TEST(DeviceSteps, FindContactsOfBodiesTooLargeForABlock) { expect_same_bytes_of_collision(10, 12); }

TEST(DeviceSteps, GiveTheBytesOfTheEngineForBodiesTooLargeForABlock) {
  const std::vector<meshes::Polycube> bodies{meshes::fractal(random_bodies(1, sponge).front(), 3), meshes::full_cube(14)};
  for (Physics physics : modes()) {
    expect_same_bytes(bodies, physics, 0.004);
    physics.materials[1].youngs_modulus_Pa = 2e4;
    physics.lateral_coupling = 0.3;
    expect_same_bytes(bodies, physics, 0.001);
  }
}

TEST(DeviceSteps, SayOfADivergingRobotWhatTheEngineSays) {
  for (Physics physics : modes()) {
    physics.integration.time_step_fraction = 1.5;
    std::vector<meshes::Polycube> bodies = random_bodies(3);
    for (const meshes::Polycube& body : random_bodies(4, std::string(27, 'm'))) bodies.push_back(body);
    std::vector<Simulation> alone = simulations_of(bodies, physics);
    std::vector<Simulation> robots = simulations_of(bodies, physics);
    std::size_t diverged = 0;
    static_cast<void>(advance_on_device_to(robots, 0.2, nullptr, Stepper::lone_thread));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      diverged += alone[i].advance_to(0.2) == io::RunStatus::diverged ? 1U : 0U;
      EXPECT_EQ(divergence_of(robots[i]), divergence_of(alone[i]));
      EXPECT_EQ(robots[i].steps(), alone[i].steps());
    }
    EXPECT_GT(diverged, 2U);
  }
}

TEST(DeviceSteps, FollowRobotsThatWalkFarInSinglePrecision) {
  Physics physics = physics_of(NumberType::float32, DampingMode::velocity);
  for (VoxelMaterial& material : physics.materials) material.static_friction = material.kinetic_friction = 0.0;
  physics.damping_ratios.global = 0.0;
  const meshes::Polycube body = meshes::bar(3);
  VoxelLoads loads;
  loads.initial_velocity_m_s.assign(body.count(), {3.0, 0.0, 0.0});
  const auto thrown = [&] {
    std::vector<Simulation> simulations;
    simulations.emplace_back(body, 0.01, physics, loads);
    return simulations;
  };
  std::vector<Simulation> alone = thrown();
  ASSERT_EQ(alone.front().advance_to(2.0), io::RunStatus::completed);
  std::vector<Simulation> robots = thrown();
  static_cast<void>(advance_on_device_to(robots, 2.0, nullptr, Stepper::lone_thread));
  ASSERT_GT(alone.front().centre_of_mass_m()[0], 5.0);
  // Origins move at other times, which rounds positions otherwise. One that stays behind loses 5e-7 m in every step.
  EXPECT_NEAR(robots.front().centre_of_mass_m()[0], alone.front().centre_of_mass_m()[0], 1e-5);
  EXPECT_NEAR(robots.front().centre_of_mass_m()[2], alone.front().centre_of_mass_m()[2], 1e-6);
}

TEST(DeviceSteps, GiveTheBytesOfTheEngineForLateralCoupling) {
  for (Physics physics : modes()) {
    physics.lateral_coupling = 0.3;
    expect_same_bytes(random_bodies(4), physics, 0.02);
    physics.integration.single_precision_rest_lengths = true;
    physics.materials[1].youngs_modulus_Pa = 2e4;
    expect_same_bytes(random_bodies(2), physics, 0.02);
  }
}

/// Hollow cells: plates on limbs off their middle, and elbows.
std::vector<meshes::Polycube> hollow_bodies() {
  meshes::Polycube table(3, 3, 2);
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) table.set({x, y, 1}, 1);
  }
  table.set({0, 0, 0}, 1);
  table.set({2, 2, 0}, 1);
  return {meshes::bar(3), table, meshes::full_cube(2), meshes::Polycube::from_digits(3, 1, 2, "101111")};
}

/// Calibrated bodies that are driven hard enough to slide on their feet.
Physics calibrated(Physics physics) {
  physics.surrogate = CalibratedBody{.parameters = tests::surrogate_example(), .outside_range = OutsideRange::warn};
  physics.surrogate->pressure_Pa = {0.0, 3000.0};
  return physics;
}

void expect_same_strains(const Physics& physics, double time_s) {
  expect_same([&] { return simulations_of(hollow_bodies(), physics); }, time_s, Stepper::lone_thread,
              [](const Simulation& robot, const Simulation& alone) {
                EXPECT_TRUE(same_bytes(numbers_of(robot), numbers_of(alone)));
                EXPECT_EQ(robot.strain_range(), alone.strain_range());
                EXPECT_EQ(divergence_of(robot), divergence_of(alone));
                EXPECT_EQ(robot.frame().contact, alone.frame().contact);
              });
}

TEST(DeviceSteps, GiveTheBytesOfTheEngineForCalibratedBodies) {
  for (const Physics& mode : modes()) {
    Physics physics = calibrated(mode);
    expect_same_strains(physics, 0.06);
    physics.actuation.ramp_s = 0.02;
    physics.surrogate->parameters.neck_ratio = 1.5;
    physics.surrogate->parameters.elbow_ratio = 2.5;
    physics.surrogate->parameters.plate_draw_in = 0.1;
    physics.surrogate->parameters.plate_rise = 0.05;
    physics.surrogate->parameters.plate_draw_in_per_Pa = 1e-3;
    physics.surrogate->parameters.plate_edge_share = 0.2;
    physics.surrogate->parameters.lateral_coupling = 0.3;
    expect_same_strains(physics, 0.06);
    physics.integration.single_precision_rest_lengths = true;
    physics.floor = false;
    expect_same_strains(physics, 0.03);
  }
}

TEST(DeviceSteps, GiveTheBytesOfTheEngineForCalibratedBodiesTooLargeForABlock) {
  for (const Physics& mode : modes()) {
    Physics physics = calibrated(mode);
    physics.surrogate->parameters.lateral_coupling = 0.3;
    expect_same_bytes({meshes::full_cube(14)}, physics, 0.02);
  }
}

TEST(DeviceSteps, GiveTheBytesOfTheEngineForPhasesOfChambers) {
  for (const Physics& mode : modes()) {
    Physics physics = calibrated(mode);
    physics.surrogate->chambers = meshes::ChamberLayout::per_phase;
    physics.collisions.exclusion_depth = 1;
    expect_same_strains(physics, 0.06);
  }
}

TEST(DeviceSteps, SayOfACalibratedBodyThatItLeftTheRangeOfValidity) {
  for (const Physics& mode : modes()) {
    Physics physics = calibrated(mode);
    physics.surrogate->outside_range = OutsideRange::refuse;
    physics.surrogate->pressure_Pa = {0.0, 2000.0};
    physics.surrogate->parameters.validity.largest_strain = 1e-3;
    std::vector<Simulation> robots = simulations_of(hollow_bodies(), physics);
    std::vector<Simulation> alone = simulations_of(hollow_bodies(), physics);
    static_cast<void>(advance_on_device_to(robots, 0.1, nullptr, Stepper::lone_thread));
    for (std::size_t i = 0; i < robots.size(); ++i) {
      EXPECT_EQ(alone[i].advance_to(0.1), io::RunStatus::diverged);
      EXPECT_EQ(divergence_of(robots[i]), divergence_of(alone[i]));
      EXPECT_EQ(robots[i].strain_range(), alone[i].strain_range());
    }
  }
}

TEST(DeviceSteps, LeaveToTheProcessorWhatDoesNotRunThere) {
  const auto with_every_term = [] {
    std::vector<Simulation> simulations;
    simulations.emplace_back(random_bodies(1).front(), 0.01, Physics{}, VoxelLoads{}, KernelOptions{.every_term = true});
    return simulations;
  };
  expect_same_bytes(with_every_term, 0.01, 1);
}

TEST(DeviceSteps, LeaveCrowdedRobotsToTheProcessor) {
  // All voxels of a full cube are pressed into the space of a few.
  Physics physics;
  physics.limits.strain = 100.0;
  physics.limits.speed_fraction = 100.0;
  physics.gravity_m_s2 = 0.0;
  const meshes::Polycube body = meshes::full_cube(5);
  VoxelLoads loads;
  for (const meshes::CellIndex& cell : body.occupied())
    loads.initial_displacement_m.push_back({-0.007 * cell.x, -0.007 * cell.y, -0.007 * cell.z});
  std::vector<Simulation> robots;
  robots.emplace_back(body, 0.01, physics, loads);
  Simulation alone(body, 0.01, physics, loads);
  const double time_s = 3.0 * alone.time_step_s();
  const DeviceAdvance advance = advance_on_device_to(robots, time_s, nullptr, Stepper::lone_thread);
  EXPECT_TRUE(advance.on_processor.front());
  EXPECT_EQ(advance.statuses.front(), alone.advance_to(time_s));
  EXPECT_TRUE(same_bytes(numbers_of(robots.front()), numbers_of(alone)));
}

TEST(DeviceSteps, StopWhenAskedAndGoOn) {
  std::vector<Simulation> robots = simulations_of(random_bodies(3), Physics{});
  const std::atomic<bool> stop{true};
  for (const io::RunStatus status : advance_on_device_to(robots, 0.01, &stop, Stepper::lone_thread).statuses)
    EXPECT_EQ(status, io::RunStatus::stopped);
  for (const io::RunStatus status : advance_on_device_to(robots, 0.01, nullptr, Stepper::lone_thread).statuses)
    EXPECT_EQ(status, io::RunStatus::completed);
  EXPECT_TRUE(advance_on_device_to({}, 0.01, nullptr, Stepper::lone_thread).statuses.empty());
}

/// Bodies of all sizes: those that fit the memory of a block, and one that does not.
std::vector<meshes::Polycube> bodies_of_all_sizes() {
  std::vector<meshes::Polycube> bodies = random_bodies(12);
  for (const meshes::Polycube& body : random_bodies(3, sponge)) bodies.push_back(meshes::fractal(body, 2));
  bodies.push_back(meshes::fractal(random_bodies(1, sponge).front(), 3));
  return bodies;
}

/// Rounding grows along the way: over less than a gait, to less than this.
double allowed_difference_m(const Physics& physics) { return physics.integration.number == NumberType::float64 ? 1e-9 : 1e-4; }

void expect_same_positions(const std::vector<meshes::Polycube>& bodies, const Physics& physics, double time_s) {
  double largest_m = 0.0;
  expect_same([&] { return simulations_of(bodies, physics); }, time_s, Stepper::graphics_processor,
              [&](const Simulation& robot, const Simulation& alone) {
                for (std::size_t i = 0; i < robot.voxel_count(); ++i) {
                  for (std::size_t k = 0; k < 3; ++k)
                    largest_m = std::max(largest_m, std::abs(robot.position_m(i)[k] - alone.position_m(i)[k]));
                }
              });
  std::cout << "  positions differ by " << largest_m << " m at most\n";
  EXPECT_LT(largest_m, allowed_difference_m(physics));
}

TEST(GraphicsProcessor, StepsRobotsAsTheEngineDoes) {
  if (const std::string obstacle = io::obstacle_to_device(); !obstacle.empty()) GTEST_SKIP() << obstacle;
  std::vector<meshes::Polycube> bodies = bodies_of_all_sizes();
  for (const Physics& physics : modes()) expect_same_positions(bodies, physics, 0.02);
  bodies.pop_back();  // all fit the memory of blocks then
  for (const Physics& physics : modes()) expect_same_positions(bodies, physics, 0.02);
}

TEST(GraphicsProcessor, StepsCalibratedBodiesAsTheEngineDoes) {
  if (const std::string obstacle = io::obstacle_to_device(); !obstacle.empty()) GTEST_SKIP() << obstacle;
  for (const Physics& mode : modes()) {
    Physics physics = calibrated(mode);
    physics.surrogate->parameters.lateral_coupling = 0.3;
    std::vector<meshes::Polycube> bodies = hollow_bodies();
    expect_same_positions(bodies, physics, 0.05);
    bodies.push_back(meshes::full_cube(14));  // too large for the memory of a block
    expect_same_positions(bodies, physics, 0.05);
  }
}

TEST(GraphicsProcessor, ComesToTheSameBytesEveryTimeWhoeverStandsBeside) {
  if (const std::string obstacle = io::obstacle_to_device(); !obstacle.empty()) GTEST_SKIP() << obstacle;
  const std::vector<meshes::Polycube> bodies = bodies_of_all_sizes();
  for (const Physics& physics : modes()) {
    std::vector<std::vector<double>> first;
    for (int run = 0; run < 2; ++run) {
      std::vector<Simulation> robots = simulations_of(bodies, physics);
      static_cast<void>(advance_on_device_to(robots, 0.05, nullptr, Stepper::graphics_processor));
      for (std::size_t i = 0; i < robots.size(); ++i) {
        if (run == 0) first.push_back(numbers_of(robots[i]));
        EXPECT_TRUE(same_bytes(numbers_of(robots[i]), first[i])) << i;
      }
    }
    std::vector<Simulation> few = simulations_of({bodies[13], bodies[4]}, physics);
    static_cast<void>(advance_on_device_to(few, 0.05, nullptr, Stepper::graphics_processor));
    EXPECT_TRUE(same_bytes(numbers_of(few[0]), first[13]));
    EXPECT_TRUE(same_bytes(numbers_of(few[1]), first[4]));
  }
}

TEST(GraphicsProcessor, SaysOfADivergingRobotThatItDiverged) {
  if (const std::string obstacle = io::obstacle_to_device(); !obstacle.empty()) GTEST_SKIP() << obstacle;
  for (Physics physics : modes()) {
    physics.integration.time_step_fraction = 1.5;
    std::vector<meshes::Polycube> bodies = random_bodies(4, std::string(27, 'm'));
    bodies.push_back(meshes::full_cube(14));
    std::vector<Simulation> robots = simulations_of(bodies, physics);
    const DeviceAdvance advance = advance_on_device_to(robots, 0.2, nullptr, Stepper::graphics_processor);
    for (std::size_t i = 0; i < robots.size(); ++i) {
      EXPECT_EQ(advance.statuses[i], io::RunStatus::diverged);
      EXPECT_FALSE(divergence_of(robots[i]).empty());
    }
  }
}

}  // namespace
}  // namespace menger::voxel
