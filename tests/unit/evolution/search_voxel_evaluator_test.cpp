#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "evolution/voxel_evaluator.h"
#include "meshes/fractal.h"
#include "meshes/reference_shapes.h"

namespace menger::evolution {
namespace {

const std::atomic<bool> never{false};

meshes::Polycube quadruped() { return meshes::Polycube::from_digits(3, 3, 3, "102000201111211112000000000"); }

TEST(VoxelEvaluator, GivesTheNetDisplacementOfTheCentreOfMass) {
  voxel::Physics undriven;
  undriven.actuation.mode = voxel::ActuationMode::none;
  const Evaluation still = VoxelEvaluator(undriven, 0.01, 0.05).evaluate(quadruped(), 1, never);
  ASSERT_EQ(still.status, io::RunStatus::completed);
  const Evaluation driven = VoxelEvaluator({}, 0.01, 0.05).evaluate(quadruped(), 1, never);
  ASSERT_EQ(driven.status, io::RunStatus::completed);
  EXPECT_LT(std::hypot((*still.displacement_m)[0], (*still.displacement_m)[1]), 1e-9);
  EXPECT_GT(std::hypot((*driven.displacement_m)[0], (*driven.displacement_m)[1]), 1e-6);
  EXPECT_GT(driven.steps, 1000U);
  EXPECT_TRUE(driven.reason.empty());
}

TEST(VoxelEvaluator, IsPure) {
  const VoxelEvaluator evaluator({}, 0.01, 0.02);
  const meshes::Polycube body = meshes::fractal(quadruped(), 2);
  const Evaluation first = evaluator.evaluate(body, 2, never);
  const Evaluation second = evaluator.evaluate(body, 2, never);
  ASSERT_EQ(first.status, io::RunStatus::completed);
  EXPECT_EQ(first.displacement_m, second.displacement_m);
  EXPECT_EQ(first.steps, second.steps);
}

TEST(VoxelEvaluator, AFailedRunHasAReasonAndNoDisplacement) {
  voxel::Physics physics;
  physics.integration.time_step_fraction = 5.0;  // far beyond the limit of stability
  const Evaluation result = VoxelEvaluator(physics, 0.01, 1.0).evaluate(quadruped(), 1, never);
  EXPECT_EQ(result.status, io::RunStatus::diverged);
  EXPECT_FALSE(result.displacement_m);
  EXPECT_NE(result.reason.find("voxel"), std::string::npos) << result.reason;
}

TEST(VoxelEvaluator, StopsWhenAsked) {
  const std::atomic<bool> stop{true};
  const Evaluation result = VoxelEvaluator({}, 0.01, 1000.0).evaluate(quadruped(), 1, stop);
  EXPECT_EQ(result.status, io::RunStatus::stopped);
  EXPECT_FALSE(result.displacement_m);
}

TEST(VoxelEvaluator, PhysicsTextNamesEverythingThatDecides) {
  const std::string text = VoxelEvaluator({}, 0.01, 2.0).physics();
  EXPECT_EQ(text, VoxelEvaluator({}, 0.01, 2.0).physics());
  EXPECT_NE(text, VoxelEvaluator({}, 0.02, 2.0).physics());
  EXPECT_NE(text, VoxelEvaluator({}, 0.01, 2.5).physics());
  voxel::Physics physics;
  physics.integration.damping = voxel::DampingMode::velocity;
  const std::string velocity = VoxelEvaluator(physics, 0.01, 2.0).physics();
  physics.integration.number = voxel::NumberType::float32;
  EXPECT_NE(text, velocity);
  EXPECT_NE(velocity, VoxelEvaluator(physics, 0.01, 2.0).physics());
}

TEST(VoxelEvaluator, DisplacementCountsFromTheTimeThatIsAskedFor) {
  // Two whole evaluations on either side of the window, whose steps are the same.
  const Evaluation whole = VoxelEvaluator({}, 0.01, 0.05).evaluate(quadruped(), 1, never);
  const Evaluation start = VoxelEvaluator({}, 0.01, 0.02).evaluate(quadruped(), 1, never);
  const Evaluation window = VoxelEvaluator({}, 0.01, 0.05, 0.02).evaluate(quadruped(), 1, never);
  ASSERT_EQ(window.status, io::RunStatus::completed);
  EXPECT_EQ(window.steps, whole.steps);
  EXPECT_EQ(window.left_out_m, start.displacement_m);
  EXPECT_FALSE(whole.left_out_m);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Positions are some 1e-2 m: differences of them are exact to 1e-17.
    EXPECT_NEAR((*window.displacement_m)[axis], (*whole.displacement_m)[axis] - (*start.displacement_m)[axis], 1e-16);
  }
  EXPECT_NE(*window.displacement_m, *whole.displacement_m);
}

TEST(VoxelEvaluator, AWindowIsPartOfThePhysicsOnlyWhereThereIsOne) {
  EXPECT_EQ(VoxelEvaluator({}, 0.01, 2.0, 0.0).physics(), VoxelEvaluator({}, 0.01, 2.0).physics());
  EXPECT_EQ(VoxelEvaluator({}, 0.01, 2.0).physics().find("measure"), std::string::npos);
  EXPECT_NE(VoxelEvaluator({}, 0.01, 2.0, 0.5).physics(), VoxelEvaluator({}, 0.01, 2.0).physics());
  EXPECT_NE(VoxelEvaluator({}, 0.01, 2.0, 0.5).physics(), VoxelEvaluator({}, 0.01, 2.0, 0.25).physics());
}

TEST(VoxelEvaluator, OneThatDivergesBeforeItCountsHasNothingLeftOut) {
  voxel::Physics physics;
  physics.integration.time_step_fraction = 5.0;  // far beyond the limit of stability
  const Evaluation result = VoxelEvaluator(physics, 0.01, 1.0, 0.9).evaluate(quadruped(), 1, never);
  EXPECT_EQ(result.status, io::RunStatus::diverged);
  EXPECT_FALSE(result.displacement_m);
  EXPECT_FALSE(result.left_out_m);
}

TEST(VoxelEvaluator, LargerBodiesCostMore) {
  const VoxelEvaluator evaluator({}, 0.01, 2.0);
  EXPECT_LT(evaluator.cost(meshes::menger_sponge(), 1), evaluator.cost(meshes::fractal(meshes::menger_sponge(), 2), 2));
}

}  // namespace
}  // namespace menger::evolution
