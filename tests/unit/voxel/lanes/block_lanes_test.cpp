// An aggregate whose blocks go in SIMD lanes comes to the bytes that it comes to voxel by voxel.

#include "voxel/lanes/block_lanes.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshes/design/connectivity.h"
#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "tests/unit/voxel/lanes/robot_numbers.h"
#include "voxel/kernels/instruction_sets.h"
#include "voxel/lanes/blocks.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

std::string said_of(const Simulation& simulation) {
  return simulation.divergence() ? divergence_text(*simulation.divergence()) : std::string();
}

bool goes_in_blocks(const Simulation& simulation) {
  for (const std::string& line : simulation.kernel_report()) {
    if (line.starts_with("blocks of the aggregate in SIMD lanes")) return true;
  }
  return false;
}

std::vector<Physics> block_modes() {
  std::vector<Physics> all(3);
  all[1].integration.damping = all[2].integration.damping = DampingMode::velocity;
  all[2].integration.number = NumberType::float32;
  return all;
}

/// Whether the blocks of a uniform aggregate fill six tenths of their registers at least, from which on they go into lanes.
bool fill_registers(const meshes::Polycube& body, const Physics& physics, InstructionSet set) {
  const std::optional<BlockBody> blocks = blocks_of(Lattice(body));
  if (!blocks) return false;
  const std::size_t lanes = most_lanes_of(physics.integration.number, set);
  const std::size_t registers = (blocks->count + lanes - 1) / lanes;
  return lanes > 1 && 10 * blocks->count >= 6 * registers * lanes;
}

/// A body steps voxel by voxel in scalar arithmetic, and by every instruction set of this machine in parts, among them single
/// steps.
void expect_same_as_voxel_by_voxel(const meshes::Polycube& body, const Physics& physics, std::uint64_t steps = 600) {
  Simulation scalar(body, 0.01, physics, {}, {.instruction_set = InstructionSet::scalar});
  ASSERT_FALSE(goes_in_blocks(scalar));
  const io::RunStatus expected = scalar.advance(steps);
  for (const InstructionSet set : {InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
    try {
      Simulation blocks(body, 0.01, physics, {}, {.instruction_set = set});
      EXPECT_EQ(goes_in_blocks(blocks), fill_registers(body, physics, set)) << static_cast<int>(set);
      static_cast<void>(blocks.advance(steps / 3));
      static_cast<void>(blocks.advance(1));
      EXPECT_EQ(blocks.advance(steps - steps / 3 - 1), expected);
      EXPECT_TRUE(same_bytes(numbers_of(blocks), numbers_of(scalar))) << static_cast<int>(set);
      EXPECT_EQ(said_of(blocks), said_of(scalar));
      if (physics.collisions.exclusion_depth) {
        EXPECT_EQ(blocks.collision_counts().list_rebuilds, scalar.collision_counts().list_rebuilds);
        EXPECT_EQ(blocks.collision_counts().steps_with_pairs, scalar.collision_counts().steps_with_pairs);
      }
    } catch (const std::invalid_argument&) {
    }
  }
}

meshes::Polycube block_sponge() { return meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211"); }
meshes::Polycube quadruped() { return meshes::Polycube::from_digits(3, 3, 3, "102000201111211112000000000"); }

TEST(Blocks, OfAFractalAreItsCopies) {
  const Lattice lattice(meshes::fractal(block_sponge(), 3));
  const auto body = blocks_of(lattice);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->count, 400U);
  EXPECT_EQ(body->places(), 20U);
  std::size_t joints = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(body->faces[axis].size(), 8U);
    joints += body->neighbours[axis].size() * body->faces[axis].size();
  }
  EXPECT_EQ(joints + 400 * 24, lattice.beam_count());
  for (std::size_t i = 0; i < lattice.voxel_count(); ++i) {
    const auto at = static_cast<std::size_t>(body->block_of[i]) * 20 + static_cast<std::size_t>(body->place[i]);
    EXPECT_EQ(body->voxel[at], static_cast<std::int32_t>(i));
  }
}

TEST(Blocks, AreNoneWhereCopiesDiffer) {
  EXPECT_FALSE(blocks_of(Lattice(block_sponge()))) << "one block";
  EXPECT_FALSE(blocks_of(Lattice(meshes::bar(4)))) << "another grid";
  meshes::Polycube body = meshes::fractal(block_sponge(), 2);
  body.set({0, 0, 0}, meshes::empty);
  EXPECT_FALSE(blocks_of(Lattice(body))) << "a copy lacks a cell";
  body.set({1, 1, 1}, 1);
  EXPECT_FALSE(blocks_of(Lattice(body))) << "and another has one more";
}

TEST(BlockLanes, AreUsedForAnAggregateOfOneMaterial) {
  const meshes::Polycube body = meshes::fractal(block_sponge(), 2);
  Physics physics;
  try {
    EXPECT_TRUE(goes_in_blocks(Simulation(body, 0.01, physics, {}, {.instruction_set = InstructionSet::avx2})));
  } catch (const std::invalid_argument&) {
    GTEST_SKIP() << "no AVX2";
  }
  EXPECT_FALSE(goes_in_blocks(Simulation(block_sponge(), 0.01, physics)));
  EXPECT_FALSE(goes_in_blocks(Simulation(body, 0.01, physics, {}, {.every_term = true})));
  physics.lateral_coupling = 0.2;
  EXPECT_FALSE(goes_in_blocks(Simulation(body, 0.01, physics)));
  physics.lateral_coupling = 0.0;
  physics.materials[1].youngs_modulus_Pa = 2e4;
  EXPECT_FALSE(goes_in_blocks(Simulation(body, 0.01, physics)));
}

TEST(BlockLanes, GiveTheBytesOfVoxelByVoxel) {
  for (const meshes::Polycube& body : {block_sponge(), quadruped(), meshes::full_cube(3), meshes::plane(3)}) {
    for (const Physics& physics : block_modes()) expect_same_as_voxel_by_voxel(meshes::fractal(body, 2), physics);
  }
}

TEST(BlockLanes, GiveTheBytesOfVoxelByVoxelForRandomBodies) {
  std::mt19937 generator(3);
  for (int bodies = 0; bodies < 6;) {
    std::string digits(27, '0');
    for (char& digit : digits) digit = static_cast<char>('0' + generator() % 3);
    const meshes::Polycube body = meshes::fractal(meshes::Polycube::from_digits(3, 3, 3, digits), 2);
    if (!meshes::is_connected(body)) continue;
    ++bodies;
    for (const Physics& physics : block_modes()) expect_same_as_voxel_by_voxel(body, physics, 300);
  }
}

TEST(BlockLanes, GiveTheBytesOfVoxelByVoxelAtTheThirdLevel) {
  for (const Physics& physics : block_modes()) expect_same_as_voxel_by_voxel(meshes::fractal(block_sponge(), 3), physics, 120);
}

TEST(BlockLanes, GiveTheBytesOfVoxelByVoxelInEveryScene) {
  for (Physics physics : block_modes()) {
    const meshes::Polycube body = meshes::fractal(quadruped(), 2);
    physics.beam_moments = BeamMoments::balanced;
    expect_same_as_voxel_by_voxel(body, physics, 300);
    physics.integration.single_precision_rest_lengths = true;
    physics.stop_rotation_in_static_friction = !physics.stop_rotation_in_static_friction;
    expect_same_as_voxel_by_voxel(body, physics, 300);
    physics.collisions.exclusion_depth.reset();
    physics.actuation.mode = ActuationMode::wave;
    expect_same_as_voxel_by_voxel(body, physics, 300);
    physics.floor = false;
    expect_same_as_voxel_by_voxel(body, physics, 300);
    physics.gravity_m_s2 = 0.0;
    physics.actuation.mode = ActuationMode::none;
    expect_same_as_voxel_by_voxel(body, physics, 100);
  }
}

TEST(BlockLanes, SayOfADivergingRobotWhatVoxelByVoxelSays) {
  for (Physics physics : block_modes()) {
    physics.integration.time_step_fraction = 1.6;
    Simulation simulation(meshes::fractal(block_sponge(), 2), 0.01, physics);
    ASSERT_EQ(simulation.advance(3000), io::RunStatus::diverged);
    expect_same_as_voxel_by_voxel(meshes::fractal(block_sponge(), 2), physics, 3000);
  }
}

TEST(BlockLanes, FollowARobotThatFliesFarInSinglePrecision) {
  // Thrown forward without a floor, far enough that the origin of positions moves.
  Physics physics = block_modes().back();
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.damping_ratios.global = 0.0;
  const meshes::Polycube body = meshes::fractal(quadruped(), 2);
  VoxelLoads loads;
  loads.initial_velocity_m_s.assign(body.count(), {2.0, 0.5, 0.0});
  Simulation scalar(body, 0.01, physics, loads, {.instruction_set = InstructionSet::scalar});
  Simulation blocks(body, 0.01, physics, loads);
  EXPECT_EQ(goes_in_blocks(blocks), fill_registers(body, physics, InstructionSet::best));
  ASSERT_EQ(scalar.advance_to(0.1), io::RunStatus::completed);
  ASSERT_EQ(blocks.advance_to(0.1), io::RunStatus::completed);
  EXPECT_GT(scalar.centre_of_mass_m()[0], 0.19);
  EXPECT_TRUE(same_bytes(numbers_of(blocks), numbers_of(scalar)));
}

TEST(BlockLanes, GiveTheSameBytesForAnyNumberOfThreads) {
  for (const Physics& physics : block_modes()) {
    const meshes::Polycube body = meshes::fractal(block_sponge(), 2);
    Simulation one(body, 0.01, physics);
    ASSERT_EQ(one.advance(300), io::RunStatus::completed);
    for (const int threads : {2, 3, 7}) {
      Simulation several(body, 0.01, physics, {}, {.threads = threads});
      ASSERT_EQ(several.advance(100), io::RunStatus::completed);
      ASSERT_EQ(several.advance(200), io::RunStatus::completed);
      EXPECT_TRUE(same_bytes(numbers_of(several), numbers_of(one))) << threads;
    }
  }
}

TEST(BlockLanes, GiveTheSameBytesWhileThreadsComeAndGo) {
  for (const Physics& physics : block_modes()) {
    const meshes::Polycube body = meshes::fractal(block_sponge(), 2);
    Simulation one(body, 0.01, physics);
    ASSERT_EQ(one.advance(400), io::RunStatus::completed);
    Simulation several(body, 0.01, physics);
    for (const int threads : {1, 3, 2, 1}) {
      several.set_threads(threads);
      ASSERT_EQ(several.advance(100), io::RunStatus::completed);
    }
    EXPECT_TRUE(same_bytes(numbers_of(several), numbers_of(one)));
  }
}

TEST(BlockLanes, GiveTheSameBytesOfABodyThatPutsItsBlocksInLanesForTwoThreadsOnly) {
  const meshes::Polycube body = meshes::fractal(meshes::Polycube::from_digits(3, 3, 3, std::string(27, '1')), 3);
  Simulation one(body, 0.01, {});
  ASSERT_EQ(one.advance(120), io::RunStatus::completed);
  Simulation several(body, 0.01, {});
  EXPECT_FALSE(goes_in_blocks(several));
  for (const int threads : {1, 2, 1}) {
    several.set_threads(threads);
    ASSERT_EQ(several.advance(40), io::RunStatus::completed);
  }
  EXPECT_EQ(goes_in_blocks(several), fill_registers(body, {}, InstructionSet::best));
  EXPECT_TRUE(same_bytes(numbers_of(several), numbers_of(one)));
}

TEST(BlockLanes, StopWhenAskedAndGoOn) {
  Simulation simulation(meshes::fractal(block_sponge(), 2), 0.01, Physics{});
  const std::atomic<bool> stop{true};
  EXPECT_EQ(simulation.advance(100, &stop), io::RunStatus::stopped);
  EXPECT_EQ(simulation.steps(), 0U);
  EXPECT_EQ(simulation.advance(100), io::RunStatus::completed);
  EXPECT_EQ(simulation.steps(), 100U);
}

}  // namespace
}  // namespace menger::voxel
