#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "evolution/study/voxel_evaluator.h"
#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"

namespace menger::evolution {
namespace {

const std::atomic<bool> not_stopped{false};
const ThreadsNow one_thread = [] { return 1; };

meshes::Polycube quadruped() { return meshes::Polycube::from_digits(3, 3, 3, "102000201111211112000000000"); }

TEST(VoxelEvaluator, GivesTheNetDisplacementOfTheCentreOfMass) {
  voxel::Physics undriven;
  undriven.actuation.mode = voxel::ActuationMode::none;
  const Evaluation still = VoxelEvaluator(undriven, 0.01, 0.05).evaluate(quadruped(), 1, not_stopped);
  ASSERT_EQ(still.status, io::RunStatus::completed);
  const Evaluation driven = VoxelEvaluator({}, 0.01, 0.05).evaluate(quadruped(), 1, not_stopped);
  ASSERT_EQ(driven.status, io::RunStatus::completed);
  EXPECT_LT(std::hypot((*still.displacement_m)[0], (*still.displacement_m)[1]), 1e-9);
  EXPECT_GT(std::hypot((*driven.displacement_m)[0], (*driven.displacement_m)[1]), 1e-6);
  EXPECT_GT(driven.steps, 1000U);
  EXPECT_TRUE(driven.reason.empty());
}

TEST(VoxelEvaluator, IsPure) {
  const VoxelEvaluator evaluator({}, 0.01, 0.02);
  const meshes::Polycube body = meshes::fractal(quadruped(), 2);
  const Evaluation first = evaluator.evaluate(body, 2, not_stopped);
  const Evaluation second = evaluator.evaluate(body, 2, not_stopped);
  ASSERT_EQ(first.status, io::RunStatus::completed);
  EXPECT_EQ(first.displacement_m, second.displacement_m);
  EXPECT_EQ(first.steps, second.steps);
}

TEST(VoxelEvaluator, AFailedRunHasAReasonAndNoDisplacement) {
  voxel::Physics physics;
  physics.integration.time_step_fraction = 5.0;  // far beyond the limit of stability
  const Evaluation result = VoxelEvaluator(physics, 0.01, 1.0).evaluate(quadruped(), 1, not_stopped);
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
  // Two whole evaluations, one ending at the start of the window and one at its end. Their steps are the same.
  const Evaluation whole = VoxelEvaluator({}, 0.01, 0.05).evaluate(quadruped(), 1, not_stopped);
  const Evaluation start = VoxelEvaluator({}, 0.01, 0.02).evaluate(quadruped(), 1, not_stopped);
  const Evaluation window = VoxelEvaluator({}, 0.01, 0.05, 0.02).evaluate(quadruped(), 1, not_stopped);
  ASSERT_EQ(window.status, io::RunStatus::completed);
  EXPECT_EQ(window.steps, whole.steps);
  EXPECT_EQ(window.left_out_m, start.displacement_m);
  EXPECT_FALSE(whole.left_out_m);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Positions are about 1e-2 m, so their differences are exact to 1e-17 m.
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
  const Evaluation result = VoxelEvaluator(physics, 0.01, 1.0, 0.9).evaluate(quadruped(), 1, not_stopped);
  EXPECT_EQ(result.status, io::RunStatus::diverged);
  EXPECT_FALSE(result.displacement_m);
  EXPECT_FALSE(result.left_out_m);
}

TEST(VoxelEvaluator, ABodyThatFallsHasNoDisplacement) {
  const meshes::Polycube gallows = meshes::Polycube::from_digits(4, 1, 5, "10001000100010001111");
  const LastPeriods last{.period_s = 0.02, .count = 5};  // it stands at the end of the first, and has fallen after some
  const VoxelEvaluator tells({}, 0.01, 2.0, 0.0, last, io::Device::cpu, 45.0);
  const Evaluation fallen = tells.evaluate(gallows, 1, not_stopped);
  EXPECT_EQ(fallen.status, io::RunStatus::fell);
  EXPECT_FALSE(fallen.displacement_m);
  EXPECT_NE(fallen.reason.find("the body has fallen: at the end of period "), std::string::npos) << fallen.reason;
  EXPECT_GE(fallen.period_displacements_m.size(), 5U) << "it is known where it went";
  const VoxelEvaluator silent({}, 0.01, 2.0, 0.0, last);
  const Evaluation went = silent.evaluate(gallows, 1, not_stopped);
  EXPECT_EQ(went.status, io::RunStatus::completed);
  EXPECT_EQ(went.period_displacements_m, fallen.period_displacements_m);
  ASSERT_TRUE(went.displacement_m && went.left_out_m && fallen.left_out_m);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR((*fallen.left_out_m)[axis], (*went.displacement_m)[axis] + (*went.left_out_m)[axis], 1e-15) << "all is left out";
  EXPECT_NE(tells.physics().find("largest_lean_deg = 45\n"), std::string::npos) << tells.physics();
  EXPECT_EQ(silent.physics().find("largest_lean_deg"), std::string::npos) << "results of earlier versions are found";
  // One that stands has the same result either way, alone and among others.
  const Evaluation stands = tells.evaluate(quadruped(), 1, not_stopped);
  EXPECT_EQ(stands.status, io::RunStatus::completed);
  EXPECT_EQ(stands.displacement_m, silent.evaluate(quadruped(), 1, not_stopped).displacement_m);
  const EvaluationTask tasks[] = {{gallows, 1}, {quadruped(), 1}};
  const EvaluationTask* const both[] = {&tasks[0], &tasks[1]};
  const std::vector<Evaluation> together = tells.evaluate_together(both, not_stopped, one_thread);
  EXPECT_EQ(together[0].status, io::RunStatus::fell);
  EXPECT_EQ(together[1].displacement_m, stands.displacement_m);
}

TEST(VoxelEvaluator, ABodyThatDivergesOrStopsHasNotFallen) {
  voxel::Physics physics;
  physics.integration.time_step_fraction = 5.0;  // far beyond the limit of stability
  const LastPeriods last{.period_s = 0.02, .count = 5};
  const Evaluation diverged =
      VoxelEvaluator(physics, 0.01, 2.0, 0.0, last, io::Device::cpu, 45.0).evaluate(quadruped(), 1, not_stopped);
  EXPECT_EQ(diverged.status, io::RunStatus::diverged);
  EXPECT_TRUE(diverged.period_displacements_m.empty());
  EXPECT_FALSE(diverged.displacement_m || diverged.left_out_m);
  const std::atomic<bool> stop{true};
  const Evaluation stopped = VoxelEvaluator({}, 0.01, 2.0, 0.0, last, io::Device::cpu, 45.0).evaluate(quadruped(), 1, stop);
  EXPECT_EQ(stopped.status, io::RunStatus::stopped);
}

/// Returns bodies on one grid, some of them equal in shape, as in a generation.
std::vector<EvaluationTask> generation() {
  std::vector<EvaluationTask> tasks;
  std::mt19937 random(11);
  for (int i = 0; i < 21; ++i) {
    std::string digits(27, '0');
    for (char& digit : digits) digit = static_cast<char>('0' + random() % 3);
    // Two thirds are the quadruped with different materials.
    meshes::Polycube body = i % 3 == 0 ? meshes::Polycube::from_digits(3, 3, 3, digits) : quadruped();
    for (const meshes::CellIndex& cell : body.occupied()) body.set(cell, static_cast<meshes::Material>(1 + random() % 2));
    tasks.push_back({body, 1});
  }
  tasks.push_back({meshes::fractal(quadruped(), 2), 2});
  return tasks;
}

std::vector<const EvaluationTask*> pointers_to(const std::vector<EvaluationTask>& tasks) {
  std::vector<const EvaluationTask*> pointers;
  for (const EvaluationTask& task : tasks) pointers.push_back(&task);
  return pointers;
}

void expect_same_as_alone(const VoxelEvaluator& evaluator) {
  const std::vector<EvaluationTask> tasks = generation();
  const std::vector<Evaluation> together = evaluator.evaluate_together(pointers_to(tasks), not_stopped, one_thread);
  ASSERT_EQ(together.size(), tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Evaluation alone = evaluator.evaluate(tasks[i].body, tasks[i].level, not_stopped);
    EXPECT_EQ(together[i].status, alone.status) << i;
    EXPECT_EQ(together[i].displacement_m, alone.displacement_m) << i;
    EXPECT_EQ(together[i].left_out_m, alone.left_out_m) << i;
    EXPECT_EQ(together[i].reason, alone.reason) << i;
    EXPECT_EQ(together[i].steps, alone.steps) << i;
    EXPECT_EQ(together[i].outside_validity, alone.outside_validity) << i;
  }
}

TEST(VoxelEvaluator, GivesTogetherWhatItGivesAlone) {
  voxel::Physics physics;
  expect_same_as_alone(VoxelEvaluator(physics, 0.01, 0.03));
  expect_same_as_alone(VoxelEvaluator(physics, 0.01, 0.03, 0.01));
  physics.integration.damping = voxel::DampingMode::velocity;
  physics.integration.number = voxel::NumberType::float32;
  physics.materials[1].youngs_modulus_Pa = 3e4;  // bodies of one material have another time step
  expect_same_as_alone(VoxelEvaluator(physics, 0.01, 0.03));
}

TEST(VoxelEvaluator, GivesTogetherWhatItGivesAloneWhereSomeDiverge) {
  voxel::Physics physics;
  physics.integration.time_step_fraction = 1.5;
  const VoxelEvaluator evaluator(physics, 0.01, 0.2, 0.05);
  std::size_t diverged = 0;
  for (const Evaluation& result : evaluator.evaluate_together(pointers_to(generation()), not_stopped, one_thread)) {
    if (result.status == io::RunStatus::diverged) ++diverged;
  }
  EXPECT_GT(diverged, 0U);
  EXPECT_LT(diverged, generation().size());
  expect_same_as_alone(evaluator);
}

TEST(VoxelEvaluator, StopsTogetherWhenAsked) {
  const std::atomic<bool> stop{true};
  const std::vector<EvaluationTask> tasks = generation();
  for (const Evaluation& result : VoxelEvaluator({}, 0.01, 1000.0).evaluate_together(pointers_to(tasks), stop, one_thread)) {
    EXPECT_EQ(result.status, io::RunStatus::stopped);
    EXPECT_FALSE(result.displacement_m);
  }
}

TEST(VoxelEvaluator, GivesTheSameOfALargeBodyWhileThreadsComeAndGo) {
  const VoxelEvaluator evaluator({}, 0.01, 0.5, 0.1);
  const EvaluationTask task{meshes::fractal(quadruped(), 3), 3};
  ASSERT_GE(task.body.count(), 2000U) << "as many as two threads are worth";
  const EvaluationTask* const alone[] = {&task};
  int asked = 0;
  const ThreadsNow changing = [&] { return 1 + asked++ % 3; };
  const Evaluation shared = evaluator.evaluate_together(alone, not_stopped, changing).front();
  EXPECT_GE(asked, 3) << "and once more to hand a thread back";
  const Evaluation result = evaluator.evaluate(task.body, task.level, not_stopped);
  ASSERT_EQ(result.status, io::RunStatus::completed);
  EXPECT_EQ(shared.status, result.status);
  EXPECT_EQ(shared.displacement_m, result.displacement_m);
  EXPECT_EQ(shared.left_out_m, result.left_out_m);
  EXPECT_EQ(shared.steps, result.steps);
}

TEST(VoxelEvaluator, GroupsModulesAndKeepsAllWorkersBusy) {
  std::vector<EvaluationTask> tasks(32, {quadruped(), 1});
  tasks.push_back({meshes::fractal(quadruped(), 2), 2});
  const auto groups_of = [&](const voxel::Physics& physics, int workers) {
    std::vector<std::vector<std::size_t>> groups = VoxelEvaluator(physics, 0.01, 1.0).groups(tasks, workers);
    std::vector<std::size_t> all;
    for (const std::vector<std::size_t>& group : groups) all.insert(all.end(), group.begin(), group.end());
    std::ranges::sort(all);
    std::vector<std::size_t> expected(tasks.size());
    std::iota(expected.begin(), expected.end(), std::size_t{0});
    EXPECT_EQ(all, expected) << "every task once";
    return groups;
  };
  const voxel::Physics physics;
  EXPECT_LT(groups_of(physics, 1).size(), tasks.size());
  const auto of_three = groups_of(physics, 3);
  const auto alone = std::ranges::find(of_three, std::vector<std::size_t>{32});
  EXPECT_NE(alone, of_three.end());
  voxel::Physics coupled;
  coupled.lateral_coupling = 0.2;
  EXPECT_EQ(groups_of(coupled, 2).size(), tasks.size());
}

TEST(VoxelEvaluator, LargerBodiesCostMore) {
  const VoxelEvaluator evaluator({}, 0.01, 2.0);
  EXPECT_LT(evaluator.cost(meshes::menger_sponge(), 1), evaluator.cost(meshes::fractal(meshes::menger_sponge(), 2), 2));
}

TEST(VoxelEvaluator, MeasuresTheLastPeriods) {
  const LastPeriods last{.period_s = 0.01, .count = 4};
  const Evaluation whole = VoxelEvaluator({}, 0.01, 0.055).evaluate(quadruped(), 1, not_stopped);
  const Evaluation result = VoxelEvaluator({}, 0.01, 0.055, 0.0, last).evaluate(quadruped(), 1, not_stopped);
  ASSERT_EQ(result.status, io::RunStatus::completed);
  EXPECT_EQ(result.steps, whole.steps) << "to look at it changes no step";
  ASSERT_EQ(result.period_displacements_m.size(), 5U);
  EXPECT_EQ(result.period_displacements_m[0],
            VoxelEvaluator({}, 0.01, 0.01).evaluate(quadruped(), 1, not_stopped).displacement_m);
  EXPECT_EQ(result.displacement_m, steady_displacement_m(result.period_displacements_m, last));
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR((*result.displacement_m)[axis] + (*result.left_out_m)[axis], (*whole.displacement_m)[axis], 1e-16);
  EXPECT_TRUE(whole.period_displacements_m.empty());
  EXPECT_NE(VoxelEvaluator({}, 0.01, 0.055, 0.0, last).physics(), VoxelEvaluator({}, 0.01, 0.055).physics());
  expect_same_as_alone(VoxelEvaluator({}, 0.01, 0.05, 0.0, last));
}

}  // namespace
}  // namespace menger::evolution
