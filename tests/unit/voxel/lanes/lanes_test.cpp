// Robots in SIMD lanes come to the bytes that they come to alone.

#include "voxel/lanes/lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "tests/unit/voxel/lanes/robot_numbers.h"

namespace menger::voxel {
namespace {

std::vector<Simulation> simulations_of(const std::vector<meshes::Polycube>& bodies, const Physics& physics) {
  std::vector<Simulation> simulations;
  for (const meshes::Polycube& body : bodies) simulations.emplace_back(body, 0.01, physics);
  return simulations;
}

/// Random bodies on a grid of 3 x 3 x 3, or with a fixed shape of random materials.
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

std::vector<InstructionSet> sets_of_this_machine() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set : {InstructionSet::scalar, InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
    try {
      Simulation(meshes::bar(2), 0.01, Physics{}, {}, {.instruction_set = set});
      sets.push_back(set);
    } catch (const std::invalid_argument&) {
    }
  }
  return sets;
}

/// Steps the bodies together in every instruction set and alone, to two times one after the other, and compares.
void expect_same_as_alone(const std::vector<meshes::Polycube>& bodies, const Physics& physics, double time_s) {
  std::vector<Simulation> alone = simulations_of(bodies, physics);
  std::vector<io::RunStatus> expected;
  for (Simulation& simulation : alone) expected.push_back(simulation.advance_to(time_s));
  for (const InstructionSet set : sets_of_this_machine()) {
    std::vector<Simulation> together = simulations_of(bodies, physics);
    static_cast<void>(advance_together_to(together, 0.4 * time_s, nullptr, set, LaneUse::always));
    EXPECT_EQ(advance_together_to(together, time_s, nullptr, set, LaneUse::always), expected);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      EXPECT_TRUE(same_bytes(numbers_of(together[i]), numbers_of(alone[i]))) << i << " of set " << static_cast<int>(set);
      const auto text = [](const Simulation& one) { return one.divergence() ? divergence_text(*one.divergence()) : ""; };
      EXPECT_EQ(text(together[i]), text(alone[i])) << i;
    }
  }
}

TEST(Lanes, GiveTheBytesOfASingleRunForRobotsOfOneShape) {
  for (const Physics& physics : modes()) expect_same_as_alone(random_bodies(17, sponge), physics, 0.03);
}

TEST(Lanes, GiveTheBytesOfASingleRunForRobotsOfManyShapes) {
  for (const Physics& physics : modes()) expect_same_as_alone(random_bodies(21), physics, 0.03);
}

TEST(Lanes, GiveTheBytesOfASingleRunForTwoMaterials) {
  for (Physics physics : modes()) {
    physics.materials[1].youngs_modulus_Pa = 2e4;
    physics.materials[1].density_kg_m3 = 15.0;
    physics.materials[1].kinetic_friction = 0.3;
    expect_same_as_alone(random_bodies(9), physics, 0.03);
  }
}

TEST(Lanes, GiveTheBytesOfASingleRunForAggregates) {
  std::vector<meshes::Polycube> bodies;
  for (const meshes::Polycube& body : random_bodies(3, sponge)) bodies.push_back(meshes::fractal(body, 2));
  for (const Physics& physics : modes()) expect_same_as_alone(bodies, physics, 0.012);
}

TEST(Lanes, GiveTheBytesOfASingleRunWithoutFloorGravityDriveAndCollisions) {
  for (Physics physics : modes()) {
    Physics floating = physics;
    floating.floor = false;
    expect_same_as_alone(random_bodies(5), floating, 0.02);
    physics.gravity_m_s2 = 0.0;
    physics.actuation.mode = ActuationMode::none;
    physics.collisions.exclusion_depth.reset();
    expect_same_as_alone(random_bodies(5), physics, 0.02);
  }
}

TEST(Lanes, FollowRobotsThatWalkFarInSinglePrecision) {
  // Without friction forward thrown bodies slide, far enough that the origin of positions moves with each of them.
  Physics physics = physics_of(NumberType::float32, DampingMode::velocity);
  physics.materials[0].static_friction = physics.materials[1].static_friction = 0.0;
  physics.materials[0].kinetic_friction = physics.materials[1].kinetic_friction = 0.0;
  physics.damping_ratios.global = 0.0;
  const auto thrown = [&] {
    std::vector<Simulation> simulations;
    for (int i = 0; i < 6; ++i) {
      const meshes::Polycube body = meshes::bar(3);
      VoxelLoads loads;
      loads.initial_velocity_m_s.assign(body.count(), {1.0 + 0.1 * i, 0.0, 0.0});
      simulations.emplace_back(body, 0.01, physics, loads);
    }
    return simulations;
  };
  std::vector<Simulation> alone = thrown();
  for (Simulation& simulation : alone) ASSERT_EQ(simulation.advance_to(0.3), io::RunStatus::completed);
  std::vector<Simulation> together = thrown();
  static_cast<void>(advance_together_to(together, 0.3, nullptr, InstructionSet::best, LaneUse::always));
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_GT(alone[i].centre_of_mass_m()[0], 0.25);
    EXPECT_TRUE(same_bytes(numbers_of(together[i]), numbers_of(alone[i]))) << i;
  }
}

TEST(Lanes, DoNotCareWhoStandsBeside) {
  for (const Physics& physics : modes()) {
    const std::vector<meshes::Polycube> bodies = random_bodies(12);
    std::vector<Simulation> all = simulations_of(bodies, physics);
    static_cast<void>(advance_together_to(all, 0.03, nullptr, InstructionSet::best, LaneUse::always));
    std::vector<Simulation> few = simulations_of({bodies[7], bodies[2], bodies[10]}, physics);
    static_cast<void>(advance_together_to(few, 0.03, nullptr, InstructionSet::best, LaneUse::always));
    EXPECT_TRUE(same_bytes(numbers_of(few[0]), numbers_of(all[7])));
    EXPECT_TRUE(same_bytes(numbers_of(few[1]), numbers_of(all[2])));
    EXPECT_TRUE(same_bytes(numbers_of(few[2]), numbers_of(all[10])));
  }
}

TEST(Lanes, SayOfADivergingRobotWhatASingleRunSays) {
  // Too large a step for the full cubes, not for the bars: some fly apart, each in its own way and time.
  for (Physics physics : modes()) {
    physics.integration.time_step_fraction = 1.5;
    std::vector<meshes::Polycube> bodies = random_bodies(6);
    for (const meshes::Polycube& body : random_bodies(6, std::string(27, 'm'))) bodies.push_back(body);
    meshes::Polycube bar(3, 3, 3);
    for (int x = 0; x < 3; ++x) bar.set({x, 0, 0}, 1);
    bodies.push_back(bar);
    std::vector<Simulation> alone = simulations_of(bodies, physics);
    std::size_t diverged = 0;
    for (Simulation& simulation : alone) diverged += simulation.advance_to(0.2) == io::RunStatus::diverged ? 1U : 0U;
    EXPECT_GT(diverged, 3U);
    EXPECT_LT(diverged, bodies.size());
    expect_same_as_alone(bodies, physics, 0.2);
  }
}

TEST(Lanes, LeaveAloneWhatDoesNotRunInThem) {
  Physics coupled;
  coupled.lateral_coupling = 0.3;
  expect_same_as_alone(random_bodies(2), coupled, 0.01);
  Physics held;
  held.actuation.mode = ActuationMode::hold;
  held.actuation.ramp_s = 0.05;
  expect_same_as_alone(random_bodies(2), held, 0.01);
}

TEST(Lanes, TakeSimulationsOfSeveralKinds) {
  Physics other;
  other.actuation.frequency_Hz = 10.0;
  const auto mixed = [&] {
    std::vector<Simulation> simulations;
    for (const meshes::Polycube& body : random_bodies(4)) {
      simulations.emplace_back(body, 0.01, Physics{});
      simulations.emplace_back(body, 0.01, other);
      simulations.emplace_back(body, 0.01, physics_of(NumberType::float32, DampingMode::velocity));
      simulations.emplace_back(meshes::fractal(body, 2), 0.01, Physics{});
    }
    static_cast<void>(simulations.front().advance(7));
    return simulations;
  };
  std::vector<Simulation> alone = mixed();
  for (Simulation& simulation : alone) static_cast<void>(simulation.advance_to(0.02));
  std::vector<Simulation> together = mixed();
  static_cast<void>(advance_together_to(together, 0.02, nullptr, InstructionSet::best, LaneUse::always));
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_TRUE(same_bytes(numbers_of(together[i]), numbers_of(alone[i]))) << i;
}

TEST(Lanes, AreUsedWhereTheyPayWithoutChangingAnything) {
  for (const Physics& physics : modes()) {
    std::vector<meshes::Polycube> bodies = random_bodies(9, sponge);
    for (const meshes::Polycube& body : random_bodies(9)) bodies.push_back(body);
    std::vector<Simulation> always = simulations_of(bodies, physics);
    static_cast<void>(advance_together_to(always, 0.02, nullptr, InstructionSet::best, LaneUse::always));
    std::vector<Simulation> faster = simulations_of(bodies, physics);
    static_cast<void>(advance_together_to(faster, 0.02));
    for (std::size_t i = 0; i < bodies.size(); ++i) EXPECT_TRUE(same_bytes(numbers_of(faster[i]), numbers_of(always[i]))) << i;
  }
}

TEST(Lanes, StopWhenAskedAndGoOn) {
  const std::vector<meshes::Polycube> bodies = random_bodies(3);
  std::vector<Simulation> stopped = simulations_of(bodies, Physics{});
  const std::atomic<bool> stop{true};
  for (const io::RunStatus status : advance_together_to(stopped, 0.01, &stop)) EXPECT_EQ(status, io::RunStatus::stopped);
  for (const Simulation& simulation : stopped) EXPECT_EQ(simulation.steps(), 0U);
  for (const io::RunStatus status : advance_together_to(stopped, 0.01)) EXPECT_EQ(status, io::RunStatus::completed);
  EXPECT_TRUE(advance_together_to({}, 0.01).empty());
}

}  // namespace
}  // namespace menger::voxel
