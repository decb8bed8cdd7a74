#include "evolution/study/walk_evaluator.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "evolution/evaluation/worker_pool.h"
#include "fem/walk/walk.h"
#include "meshes/design/fractal.h"
#include "tests/support/test_folder.h"
#include "tests/support/walking_study.h"

namespace menger::evolution {
namespace {

const std::atomic<bool> never{false};

meshes::Polycube hook() { return meshes::Polycube::from_digits(2, 1, 2, "1110"); }
meshes::Polycube bar() { return meshes::Polycube::from_digits(2, 1, 1, "11"); }

class WalkEvaluatorTest : public testing::Test {
 protected:
  [[nodiscard]] Study read(const std::string& text = tests::walking_study_text()) const {
    return tests::read_walking_study(folder_ / "study.toml", text);
  }

  const tests::TestFolder folder_;
};

TEST_F(WalkEvaluatorTest, GivesTheDisplacementOfTheWalk) {
  const Study study = read();
  const Evaluation result = WalkEvaluator(study).evaluate(hook(), 1, never);
  ASSERT_EQ(result.status, io::RunStatus::completed) << result.reason;
  const fem::WalkResult walk = fem::walk(walk_of(study, hook(), 1));
  EXPECT_EQ(*result.displacement_m, fem::travel_of(walk)->displacement_m);
  EXPECT_GT(std::hypot((*result.displacement_m)[0], (*result.displacement_m)[1]), 1e-6);
  EXPECT_FALSE(result.left_out_m);
  EXPECT_EQ(result.steps, walk.steps);
  EXPECT_EQ(result.elements, walk.elements);
  EXPECT_EQ(result.fidelity, "draft");
  EXPECT_EQ(result.period_displacements_m, fem::period_displacements_m(walk, 0.025));
  EXPECT_EQ(result.period_displacements_m.size(), 2U);
}

// Two modules of two cells each: the walk of `menger locomote` with design.level = 2.
TEST_F(WalkEvaluatorTest, AggregatesWalkAsTheFractalsOfTheirModule) {
  std::string text = tests::walking_study_text();
  text.replace(text.find("levels = [1]"), 12, "levels = [2]");
  const Study study = read(text);
  const Evaluation result = WalkEvaluator(study).evaluate(meshes::fractal(bar(), 2), 2, never);
  ASSERT_EQ(result.status, io::RunStatus::completed) << result.reason;
  fem::WalkInput walk = walk_of(study, bar(), 1);
  walk.hollow.level = 2;
  const fem::WalkResult expected = fem::walk(walk);
  EXPECT_EQ(*result.displacement_m, fem::travel_of(expected)->displacement_m);
  EXPECT_EQ(result.elements, expected.elements);
  EXPECT_GT(result.elements, WalkEvaluator(study).evaluate(bar(), 1, never).elements) << "more than one module";
}

TEST_F(WalkEvaluatorTest, AggregatesOfDifferentModulesAreRefused) {
  const Evaluation result = WalkEvaluator(read()).evaluate(meshes::Polycube::from_digits(4, 1, 1, "1112"), 2, never);
  EXPECT_EQ(result.status, io::RunStatus::diverged);
  ASSERT_TRUE(refusal_of(result));
  EXPECT_EQ(*refusal_of(result), "the body is not the fractal of level 2 of a module");
}

TEST_F(WalkEvaluatorTest, IsPureAndTheSameInAnyNumberOfThreads) {
  const WalkEvaluator evaluator(read());
  const std::vector<EvaluationTask> tasks{{bar(), 1}, {hook(), 1}, {bar(), 1}, {hook(), 1}};
  std::vector<std::vector<Evaluation>> found;
  for (const int threads : {1, 2, 3}) {
    std::vector<Evaluation> results(tasks.size());
    EXPECT_EQ(WorkerPool(threads).run(evaluator, tasks, nullptr,
                                      [&](std::size_t task, const Evaluation& result) { results[task] = result; }),
              io::RunStatus::completed);
    found.push_back(results);
  }
  for (const std::vector<Evaluation>& results : found) {
    for (std::size_t n = 0; n < tasks.size(); ++n) {
      EXPECT_EQ(results[n].displacement_m, found[0][n % 2].displacement_m) << n;
      EXPECT_EQ(results[n].steps, found[0][n % 2].steps);
      EXPECT_EQ(results[n].period_displacements_m, found[0][n % 2].period_displacements_m);
    }
  }
  EXPECT_NE(found[0][0].displacement_m, found[0][1].displacement_m);
}

TEST_F(WalkEvaluatorTest, StopsWithinASecond) {
  Study study = read();
  study.duration_s = 500.0;
  const WalkEvaluator evaluator(study);
  std::atomic<bool> stop{false};
  Evaluation result;
  std::chrono::steady_clock::time_point told;
  {
    const std::jthread walking([&] { result = evaluator.evaluate(hook(), 1, stop); });
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    told = std::chrono::steady_clock::now();
    stop = true;
  }
  EXPECT_LT(std::chrono::steady_clock::now() - told, std::chrono::seconds(1));
  EXPECT_EQ(result.status, io::RunStatus::stopped);
  EXPECT_FALSE(result.displacement_m);
  EXPECT_TRUE(result.period_displacements_m.empty());
}

TEST_F(WalkEvaluatorTest, ABodyThatIsRefusedHasAReasonAndNoDisplacement) {
  const WalkEvaluator evaluator(read());
  for (const auto& [body, word] : {std::pair{meshes::Polycube::from_digits(3, 3, 1, "111101110"), "touch only along an edge"},
                                   std::pair{meshes::Polycube::from_digits(3, 1, 1, "101"), "2 parts that are not joined"}}) {
    const Evaluation result = evaluator.evaluate(body, 1, never);
    EXPECT_EQ(result.status, io::RunStatus::diverged);
    EXPECT_FALSE(result.displacement_m);
    EXPECT_EQ(result.steps, 0U);
    EXPECT_NE(result.reason.find("finite elements refuse the body: "), std::string::npos) << result.reason;
    EXPECT_NE(result.reason.find(word), std::string::npos) << result.reason;
  }
}

TEST_F(WalkEvaluatorTest, PhysicsTextNamesEverythingThatDecides) {
  const auto physics = [&](const std::string& text) { return WalkEvaluator(read(text)).physics(); };
  const std::string usual = physics(tests::walking_study_text());
  EXPECT_EQ(usual, physics(tests::walking_study_text()));
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = tests::walking_study_text();
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  std::set<std::string> all{usual};
  const std::vector<std::string> others{
      tests::walking_study_text("", "", "[elements]\nfidelity = \"standard\"\n"),
      tests::walking_study_text("", "", "[elements]\nprecision = \"double\"\n"),
      tests::walking_study_text("", "", "[elements]\nkind = \"three_field\"\n"),
      tests::walking_study_text("", "", "[elements]\nkind = \"three_field\"\nelements_through_wall = 2\n"),
      tests::walking_study_text("", "", "[elements]\nstep_safety = 0.7\n"),
      tests::walking_study_text("", "", "bulk_modulus_ratio = 60\n"),
      tests::walking_study_text("", "", "youngs_modulus_Pa = 2e5\n"),
      tests::walking_study_text("", "", "loss_factor = 0.2\nloss_frequency_Hz = 30\n"),
      tests::walking_study_text("", "", "damping_model = \"kelvin_voigt\"\n"),
      tests::walking_study_text("", "", "density_kg_per_m3 = 1000\n"),
      tests::walking_study_text("", "", "[ground]\nkinetic_friction = 0.4\n"),
      tests::walking_study_text("", "", "[ground]\nstatic_friction = 0.9\n"),
      tests::walking_study_text("", "", "[loads]\ngravity_m_per_s2 = 9\n"),
      tests::walking_study_text("", "ramp_s = 0.01\n"),
      with("silicone = \"dragon_skin_10\"", "silicone = \"ecoflex_00_30\""),
      with("wall_thickness_m = 0.002", "wall_thickness_m = 0.0015"),
      with("wall_thickness_m = 0.002", "wall_thickness_m = 0.002\ncell_edge_m = 0.012"),
      with("wall_thickness_m = 0.002", "wall_thickness_m = 0.002\nchambers = \"per-phase\""),
      with("pressure_Pa = [0, 6000]", "pressure_Pa = [0, 5000]"),
      with("frequency_Hz = 40", "frequency_Hz = 50"),
      with("duration_s = 0.05", "duration_s = 0.06"),
      with("duration_s = 0.05", "duration_s = 0.05\nmeasure_from_s = 0.025"),
  };
  for (std::size_t n = 0; n < others.size(); ++n) {
    EXPECT_TRUE(all.insert(physics(others[n])).second) << n << ": " << others[n];
  }
  Study last = read();
  last.measure = Measure::last_periods;
  EXPECT_TRUE(all.insert(WalkEvaluator(last).physics()).second);
  last.measure_periods = 6;
  EXPECT_TRUE(all.insert(WalkEvaluator(last).physics()).second);
  last.largest_lean_deg = 30.0;
  EXPECT_TRUE(all.insert(WalkEvaluator(last).physics()).second);
  last.confirm = 7;
  EXPECT_FALSE(all.insert(WalkEvaluator(last).physics()).second);
  EXPECT_EQ(physics(tests::walking_study_text("pruning = false\n")), usual) << "the course of a search is no physics";
}

TEST_F(WalkEvaluatorTest, HalfTheStepIsAnotherPhysics) {
  Study study = read();
  const WalkEvaluator whole(study);
  study.silicone.step_safety *= 0.5;
  const WalkEvaluator half(study);
  EXPECT_NE(whole.physics(), half.physics());
  EXPECT_GT(half.evaluate(bar(), 1, never).steps, 1.8 * static_cast<double>(whole.evaluate(bar(), 1, never).steps));
}

TEST_F(WalkEvaluatorTest, DisplacementCountsFromTheTimeThatIsAskedFor) {
  Study study = read();
  const Evaluation whole = WalkEvaluator(study).evaluate(hook(), 1, never);
  study.measure_from_s = 0.025;
  const Evaluation later = WalkEvaluator(study).evaluate(hook(), 1, never);
  ASSERT_TRUE(later.displacement_m && later.left_out_m && whole.displacement_m);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR((*later.displacement_m)[axis] + (*later.left_out_m)[axis], (*whole.displacement_m)[axis], 1e-15);
    EXPECT_NEAR((*later.displacement_m)[axis], whole.period_displacements_m[1][axis], 1e-15);
  }
}

TEST_F(WalkEvaluatorTest, MeasuresTheLastPeriods) {
  Study study = read();
  study.duration_s = 0.15;
  study.measure = Measure::last_periods;
  study.measure_periods = 5;
  const Evaluation result = WalkEvaluator(study).evaluate(hook(), 1, never);
  ASSERT_EQ(result.status, io::RunStatus::completed) << result.reason;
  ASSERT_EQ(result.period_displacements_m.size(), 6U);
  const LastPeriods last{.period_s = 0.025, .count = 5};
  EXPECT_EQ(result.displacement_m, steady_displacement_m(result.period_displacements_m, last));
  std::array<double, 3> sum{};
  for (const auto& one : result.period_displacements_m)
    for (std::size_t axis = 0; axis < 3; ++axis) sum.at(axis) += one.at(axis);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR((*result.displacement_m)[axis] + (*result.left_out_m)[axis], sum.at(axis), 1e-15);
}

TEST_F(WalkEvaluatorTest, AWalkWithTooFewPeriodsHasNoDisplacement) {
  Study study = read();
  study.measure = Measure::last_periods;
  study.measure_periods = 2;
  fem::WalkResult walk;
  walk.records = {{.time_s = 0.0}, {.time_s = 0.049}};
  Evaluation result;
  result.status = io::RunStatus::completed;
  measure(study, walk, result);
  EXPECT_EQ(result.status, io::RunStatus::diverged);
  EXPECT_FALSE(result.displacement_m);
  EXPECT_EQ(result.reason, "the walk has 1 whole periods, fewer than the 2 that are measured");
}

TEST_F(WalkEvaluatorTest, ABodyThatHasFallenHasNoDisplacement) {
  Study study = read();
  study.measure = Measure::last_periods;
  study.measure_periods = 5;
  study.duration_s = 0.15;
  fem::WalkResult walk;
  for (int n = 0; n <= 6; ++n) {
    fem::WalkRecord record{.time_s = 0.025 * n};
    record.centre_of_mass_m = {1e-3 * n, 0.0, 0.01};
    if (n >= 4) record.upright = {0.8, 0.0, 0.6};  // 53 degrees
    walk.records.push_back(record);
  }
  const auto measured = [&] {
    Evaluation result;
    result.status = io::RunStatus::completed;
    measure(study, walk, result);
    return result;
  };
  const Evaluation fallen = measured();
  EXPECT_EQ(fallen.status, io::RunStatus::fell);
  EXPECT_FALSE(fallen.displacement_m);
  ASSERT_EQ(fallen.period_displacements_m.size(), 6U) << "where it got is kept";
  EXPECT_NEAR(fallen.period_displacements_m[4][0], 1e-3, 1e-15);
  ASSERT_TRUE(fallen.left_out_m);
  EXPECT_NEAR((*fallen.left_out_m)[0], 6e-3, 1e-15);
  EXPECT_EQ(fallen.reason,
            "the body has fallen: at the end of period 4 it leans by 53 degrees from where it was at the end of the first");
  study.largest_lean_deg = 60.0;
  ASSERT_TRUE(measured().displacement_m);
  EXPECT_NEAR((*measured().displacement_m)[0], 1e-3, 1e-15);
  study.largest_lean_deg = 10.0;
  study.measure = Measure::net_displacement;
  EXPECT_TRUE(measured().displacement_m) << "only a fitness that rewards walking asks how a body stands";
  study.measure = Measure::last_periods;
  study.largest_lean_deg = 180.0;
  ASSERT_TRUE(measured().displacement_m);
  walk.records.back().upright[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(measured().status, io::RunStatus::diverged);
  EXPECT_TRUE(measured().period_displacements_m.empty());
  EXPECT_FALSE(measured().left_out_m);
  EXPECT_NE(measured().reason.find("the upright axis of the body is not a number"), std::string::npos) << measured().reason;
}

TEST_F(WalkEvaluatorTest, AHookKeepsItsPostureWhileItWalks) {
  Study study = read();
  study.duration_s = 0.15;
  const fem::WalkResult walk = fem::walk(walk_of(study, hook(), 1));
  ASSERT_EQ(walk.records.front().upright, (fem::Point{0.0, 0.0, 1.0}));
  for (const fem::WalkRecord& record : walk.records) EXPECT_GT(record.upright[2], 0.8) << record.time_s;
  EXPECT_GT(fem::largest_lean(walk, 0.025).angle_deg, 0.0);
  EXPECT_LT(fem::largest_lean(walk, 0.025).angle_deg, 45.0);
}

TEST_F(WalkEvaluatorTest, CostsGrowWithTheElements) {
  const Study study = read();
  const WalkEvaluator draft(study);
  Study finer = study;
  finer.silicone.elements.fidelity = fem::Fidelity::fine;
  const WalkEvaluator fine(finer);
  std::vector<std::pair<double, std::size_t>> found;
  for (const char* digits : {"110000000", "111000000", "111010000", "111010111", "111111111"}) {
    const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 1, digits);
    fem::PreparedWalk walk{walk_of(study, body, 1)};
    fem::prepare(walk);
    found.emplace_back(draft.cost(body, 1), walk.mesh.elements.size());
    EXPECT_GT(fine.cost(body, 1), draft.cost(body, 1));
  }
  for (std::size_t n = 1; n < found.size(); ++n) {
    EXPECT_EQ(found[n].first > found[n - 1].first, found[n].second > found[n - 1].second) << n;
    EXPECT_NEAR(found[n].first / static_cast<double>(found[n].second), 1.0, 0.5) << "it is about that number";
  }
}

TEST(RecordInterval, DividesThePeriodOfTheDrive) {
  Study study;
  study.duration_s = 5.0;
  study.physics.actuation.frequency_Hz = 3.0;
  EXPECT_DOUBLE_EQ(record_interval_s(study), 1.0 / 90.0);
  study.physics.actuation.frequency_Hz = 0.5;
  EXPECT_DOUBLE_EQ(record_interval_s(study), 0.02);
  study.duration_s = 0.001;
  EXPECT_DOUBLE_EQ(record_interval_s(study), 0.001);
}

}  // namespace
}  // namespace menger::evolution
