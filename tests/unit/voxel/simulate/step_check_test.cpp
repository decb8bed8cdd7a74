#include "voxel/simulate/step_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "io/text/csv_table.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"
#include "voxel/simulate/simulation_run.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;

/// A single voxel that nothing drives.
class StepCheckOf : public testing::Test {
 protected:
  StepCheckOf() {
    scene_.design = {.name = "voxel", .body = meshes::Polycube::from_digits(1, 1, 1, "1"), .cell_edge_m = 0.01};
    scene_.duration_s = 0.02;
    scene_.record_interval_s = 0.002;
    scene_.output = {.frames = false, .pictures = false};
    scene_.physics.actuation.mode = ActuationMode::none;
    scene_.physics.damping_ratios.global = 0.0;
  }

  [[nodiscard]] SceneResult checked(const std::string& name = "run", const RunOptions& options = {}) const {
    SceneResult result = run_scene(scene_, folder_ / name, options);
    add_step_check(scene_, folder_ / name, options, result);
    return result;
  }

  /// A pair of cells of opposite phase that walks.
  void let_a_pair_walk() {
    scene_.design = {.name = "pair", .body = meshes::Polycube::from_digits(2, 1, 1, "12"), .cell_edge_m = 0.01};
    scene_.physics = {};
  }

  Scene scene_;
  const tests::TestFolder folder_;
};

TEST_F(StepCheckOf, AFreeFallIsTheSumOfTheScheme) {
  // From rest the scheme falls by g/2 (t^2 + t h): half the step is g t h / 4 higher, most at the end.
  scene_.physics.floor = false;
  const SceneResult result = checked();
  ASSERT_TRUE(result.step_check);
  const StepCheck& check = *result.step_check;
  ASSERT_EQ(check.status, io::RunStatus::completed);
  EXPECT_EQ(check.time_step_s, 0.5 * result.time_step_s);
  EXPECT_EQ(check.steps, 2 * result.steps);
  const double expected_m = 0.25 * scene_.physics.gravity_m_s2 * result.time_s * result.time_step_s;
  EXPECT_NEAR(check.largest_distance_m, expected_m, 1e-14);  // rounding of sums of 2 mm
  EXPECT_EQ(check.largest_distance_time_s, result.time_s);
  EXPECT_EQ(check.horizontal_change_m, 0.0);
}

/// Heights after the steps 0, 1, ... of m z'' = -m g - 2 E L z - c z', from rest, by the same scheme but of one number.
std::vector<double> heights(double gravity, double frequency2, double damping_rate, double step, std::size_t count) {
  std::vector<double> all{0.0};
  double height = 0.0;
  double speed = 0.0;
  while (all.size() <= count) {
    speed += step * (-gravity - frequency2 * height - damping_rate * speed);
    height += step * speed;
    all.push_back(height);
  }
  return all;
}

TEST_F(StepCheckOf, AVoxelThatSwingsOnTheFloorIsThatOfAnOscillator) {
  // It never leaves the floor: it starts where it touches, and is damped. m = 1e-5 kg, E L = 100 N/m.
  scene_.physics.gravity_m_s2 = 500.0;  // for digits: it sinks by 25 um
  scene_.physics.damping_ratios.collision = 0.1;
  scene_.record_interval_s = 1e-5;  // every step is a record
  const double frequency2 = 2.0 * 100.0 / 1e-5;
  const double damping_rate = 2.0 * 0.1 * std::sqrt(1e-5 * 100.0) / 1e-5;
  const SceneResult result = checked();
  const StepCheck& check = result.step_check.value();
  ASSERT_EQ(check.status, io::RunStatus::completed);
  ASSERT_EQ(check.trajectory.size(), result.steps + 1);
  const double step = result.time_step_s;
  const auto whole = heights(500.0, frequency2, damping_rate, step, result.steps);
  const auto half = heights(500.0, frequency2, damping_rate, 0.5 * step, 2 * result.steps);
  double largest = 0.0;
  for (std::size_t i = 0; i < whole.size(); ++i) largest = std::max(largest, std::abs(whole[i] - half[2 * i]));
  EXPECT_GT(largest, 1e-7);
  EXPECT_NEAR(check.largest_distance_m / largest, 1.0, 1e-9);  // the order of additions differs
}

TEST_F(StepCheckOf, DifferencesHalveWithTheStep) {
  // First order: the next term of the error makes the ratio 2 + O(h), 1 % at a tenth of the recommended step.
  scene_.physics.damping_ratios.collision = 0.1;
  scene_.physics.gravity_m_s2 = 500.0;
  std::vector<double> differences;
  for (const double fraction : {0.1, 0.05, 0.025}) {
    scene_.physics.integration.time_step_fraction = fraction;
    differences.push_back(checked(std::to_string(fraction)).step_check.value().largest_distance_m);
  }
  EXPECT_NEAR(differences[0] / differences[1], 2.0, 0.1);
  EXPECT_NEAR(differences[1] / differences[2], 2.0, 0.05);
}

TEST_F(StepCheckOf, BothRunsAreComparedAtTheSameTimes) {
  let_a_pair_walk();
  const SceneResult result = checked();
  const StepCheck& check = result.step_check.value();
  ASSERT_EQ(check.trajectory.size(), result.trajectory.size());
  for (std::size_t i = 0; i < check.trajectory.size(); ++i)
    EXPECT_EQ(check.trajectory[i].time_s, result.trajectory[i].time_s) << i;
  EXPECT_GT(check.largest_distance_m, 0.0);
}

TEST_F(StepCheckOf, ItIsARunOfTheSceneWithHalfTheStep) {
  let_a_pair_walk();
  const SceneResult result = checked();
  scene_.physics.integration.time_step_fraction *= 0.5;
  // The step count of the whole run is even, so that both end at the same time.
  const SceneResult halved = run_scene(scene_, folder_ / "halved");
  ASSERT_EQ(halved.time_s, result.step_check->time_s);
  EXPECT_EQ(halved.displacement_m, result.step_check->displacement_m);
}

TEST_F(StepCheckOf, FilesSayWhatWasFound) {
  let_a_pair_walk();
  const SceneResult result = checked();
  const StepCheck& check = result.step_check.value();
  const io::TomlTable text = io::read_toml(folder_ / "run/result.toml");
  EXPECT_EQ(text.text("status"), "completed");
  const io::TomlTable table = text.table("check_dt");
  EXPECT_EQ(table.text("status"), "completed");
  EXPECT_EQ(table.number("time_step_s"), check.time_step_s);
  EXPECT_DOUBLE_EQ(table.number("horizontal_displacement_m"),
                   text.number("horizontal_displacement_m") + table.number("horizontal_change_m"));
  EXPECT_EQ(table.number("largest_distance_m"), check.largest_distance_m);
  const std::vector<double> distances = io::read_csv(folder_ / "run/check_dt.csv").numbers("distance_m");
  EXPECT_EQ(*std::max_element(distances.begin(), distances.end()), check.largest_distance_m);
}

TEST_F(StepCheckOf, ResultIsTheSameOnASecondRunAndLeavesTheRunAsItWas) {
  let_a_pair_walk();
  static_cast<void>(checked("a"));
  static_cast<void>(checked("b"));
  for (const char* file : {"result.toml", "check_dt.csv"})
    EXPECT_EQ(io::read_whole(folder_ / "a" / file), io::read_whole(folder_ / "b" / file)) << file;
  static_cast<void>(run_scene(scene_, folder_ / "unchecked"));
  EXPECT_EQ(io::read_whole(folder_ / "a/trajectory.csv"), io::read_whole(folder_ / "unchecked/trajectory.csv"));
  EXPECT_EQ(io::read_whole(folder_ / "a/result.toml").rfind(io::read_whole(folder_ / "unchecked/result.toml"), 0), 0U);
  static_cast<void>(run_scene(scene_, folder_ / "a"));
  EXPECT_FALSE(fs::exists(folder_ / "a/check_dt.csv")) << "of an earlier run";
}

TEST_F(StepCheckOf, ARunThatDivergesForItsStepCompletesWithHalfOfIt) {
  // The bonds' damping bounds the step of this body to 1.26 of the recommended one: 2 is too long, 1 is not.
  scene_.design = {
      .name = "sponge", .body = meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211"), .cell_edge_m = 0.01};
  scene_.level = 2;
  scene_.physics = {};
  scene_.physics.integration.time_step_fraction = 2.0;
  const SceneResult result = checked();
  ASSERT_EQ(result.status, io::RunStatus::diverged);
  const StepCheck& check = result.step_check.value();
  EXPECT_EQ(check.status, io::RunStatus::completed) << check.reason;
  EXPECT_TRUE(check.displacement_m);
  EXPECT_FALSE(check.horizontal_change_m);
  EXPECT_EQ(check.trajectory.size(), result.trajectory.size());
  EXPECT_EQ(io::read_toml(folder_ / "run/result.toml").text("status"), "diverged");
}

TEST_F(StepCheckOf, AStopKeepsTheRun) {
  let_a_pair_walk();
  const SceneResult whole = run_scene(scene_, folder_ / "run");
  SceneResult result = whole;
  std::atomic<bool> stop = false;
  RunOptions options;
  options.stop = &stop;
  options.progress = [&](const RunProgress& now) { stop = now.time_s >= 0.01; };
  add_step_check(scene_, folder_ / "run", options, result);
  const StepCheck& check = result.step_check.value();
  EXPECT_EQ(check.status, io::RunStatus::stopped);
  EXPECT_FALSE(check.displacement_m);
  EXPECT_LT(check.trajectory.size(), whole.trajectory.size());
  const io::TomlTable text = io::read_toml(folder_ / "run/result.toml");
  EXPECT_EQ(text.text("status"), "completed");
  EXPECT_EQ(text.table("check_dt").text("status"), "stopped");
}

}  // namespace
}  // namespace menger::voxel
