// Studies whose robots walk in several scenarios.

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "evolution/report/study_view.h"
#include "evolution/study/scenarios.h"
#include "evolution/study/study_file.h"
#include "evolution/study/walk_evaluator.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"
#include "tests/support/walking_study.h"

namespace menger::evolution {
namespace {

using tests::walking_study_text;

class RobustStudy : public testing::Test {
 protected:
  [[nodiscard]] Study read(const std::string& robust, const std::string& evaluation = "") const {
    return tests::read_walking_study(folder_ / "study.toml", walking_study_text(evaluation, "", robust));
  }
  void expect_refused(const std::string& robust, const std::string& fault) const {
    const std::string message = tests::message_of([&] { (void)read(robust); });
    EXPECT_NE(message.find("study.toml"), std::string::npos) << message;
    EXPECT_NE(message.find(fault), std::string::npos) << message;
  }

  const tests::TestFolder folder_;
};

TEST_F(RobustStudy, HasSixScenariosUnlessItStatesOthers) {
  const Study study = read("[robust]\n");
  const std::vector<Scenario> scenarios = scenarios_of(study);
  const std::vector<Scenario> expected{{0.4, 0.059}, {0.4, 0.146}, {0.8, 0.059}, {0.8, 0.146}, {1.2, 0.059}, {1.2, 0.146}};
  EXPECT_EQ(scenarios, expected);
  EXPECT_EQ(study.search.scenarios, 6U);
  EXPECT_EQ(study.search.quantile, 0.0);
  const Study other = read("[robust]\nfrictions = [0.5]\nloss_factors = [0.1, 0.2]\nquantile = 0.5\n");
  EXPECT_EQ(scenarios_of(other), (std::vector<Scenario>{{0.5, 0.1}, {0.5, 0.2}}));
  EXPECT_EQ(other.search.left_out_scenarios(), 1U);
  EXPECT_TRUE(scenarios_of(read("")).empty());
  EXPECT_EQ(read("").search.scenarios, 1U);
}

TEST_F(RobustStudy, IsReadBackFromItsText) {
  for (const std::string robust : {"", "[robust]\n", "[robust]\nfrictions = [0.5, 2]\nquantile = 0.25\n"}) {
    const Study study = read(robust);
    EXPECT_EQ(study_from_text(resolved_text(study), "archive"), study);
  }
  EXPECT_NE(identity_text(read("[robust]\n")), identity_text(read("")));
  EXPECT_NE(identity_text(read("[robust]\n")), identity_text(read("[robust]\nquantile = 0.5\n")));
}

TEST_F(RobustStudy, EveryScenarioIsAPhysicsOfItsOwn) {
  const Study study = read("[robust]\n");
  const auto evaluator = evaluator_of(study);
  const std::vector<std::string> physics = evaluator->scenarios();
  ASSERT_EQ(physics.size(), 6U);
  EXPECT_EQ(std::set(physics.begin(), physics.end()).size(), 6U);
  EXPECT_EQ(evaluator->physics(), physics.front());
  for (std::size_t n = 0; n < physics.size(); ++n) {
    const Scenario scenario = scenarios_of(study)[n];
    const Study one = in_scenario(study, scenario);
    EXPECT_EQ(WalkEvaluator(one).physics(), physics[n]);
    const fem::WalkInput walk = walk_of(one, meshes::Polycube::from_digits(1, 1, 1, "1"), 1);
    EXPECT_EQ(walk.stated_ground.friction.static_coefficient, scenario.friction);
    EXPECT_EQ(walk.stated_ground.friction.kinetic_coefficient, scenario.friction);
    EXPECT_EQ(walk.silicone.loss_factor, scenario.loss_factor);
  }
  EXPECT_EQ(evaluator_of(read(""))->scenarios().size(), 1U);
}

TEST_F(RobustStudy, RefusesWhatMakesNoScenario) {
  expect_refused("[robust]\nfrictions = []\n", "robust.frictions");
  expect_refused("[robust]\nfrictions = [0.4, -1]\n", "robust.frictions");
  expect_refused("[robust]\nfrictions = [0.4, 0.4]\n", "must be different");
  expect_refused("[robust]\nloss_factors = [0.1, 0.1]\n", "must be different");
  expect_refused("[robust]\nquantile = 1\n", "robust.quantile = 1");
  expect_refused("[robust]\nscenarios = 3\n", "robust.scenarios");
  expect_refused("[robust]\n[check_dt]\n", "[check_dt]: beside [robust]");
  std::string steady = walking_study_text("", "", "[robust]\n");
  steady.replace(steady.find("mutants = 3\n"), 12, "mutants = 3\nselection = \"steady_state\"\n");
  const std::string with_steady_state =
      tests::message_of([&] { (void)tests::read_walking_study(folder_ / "study.toml", steady); });
  EXPECT_NE(with_steady_state.find("study.toml: population.selection = \"steady_state\": cannot be combined with [robust]"),
            std::string::npos)
      << with_steady_state;
}

constexpr const char* voxel_study =
    "preset = \"paper\"\ngenerations = 1\nseed = 1\n[population]\nsurvivors = 2\nmutants = 2\nnewcomers = 1\n"
    "[body]\nlevels = [1]\n[time]\nduration_s = 0.02\n";

TEST_F(RobustStudy, VoxelsWalkOnEachGround) {
  const Study study =
      tests::read_walking_study(folder_ / "study.toml", std::string(voxel_study) + "[robust]\nfrictions = [0.3, 0.9]\n");
  EXPECT_EQ(scenarios_of(study), (std::vector<Scenario>{{0.3, std::nullopt}, {0.9, std::nullopt}}));
  EXPECT_EQ(study.search.scenarios, 2U);
  EXPECT_EQ(scenario_text(scenarios_of(study).front()), "friction = 0.3");
  EXPECT_EQ(study_from_text(resolved_text(study), "archive"), study);
  const auto evaluator = evaluator_of(study);
  const std::vector<std::string> physics = evaluator->scenarios();
  ASSERT_EQ(physics.size(), 2U);
  EXPECT_NE(physics[0], physics[1]);
  EXPECT_EQ(evaluator_of(in_scenario(study, scenarios_of(study)[1]))->physics(), physics[1]) << "each as a study of its own";

  // Robots of one scenario share the lanes of a register, and come to what they come to alone.
  std::vector<EvaluationTask> tasks;
  for (const std::size_t scenario : {0U, 1U, 0U, 1U, 1U})
    tasks.push_back({.body = meshes::Polycube::from_digits(2, 1, 1, tasks.size() % 2 == 0 ? "12" : "21"), .scenario = scenario});
  const std::vector<std::vector<std::size_t>> groups = evaluator->groups(tasks, 1);
  std::multiset<std::size_t> grouped;
  const std::atomic<bool> stop{false};
  for (const std::vector<std::size_t>& group : groups) {
    std::vector<const EvaluationTask*> together;
    for (const std::size_t n : group) {
      grouped.insert(n);
      together.push_back(&tasks[n]);
      EXPECT_EQ(tasks[n].scenario, tasks[group.front()].scenario);
    }
    const std::vector<Evaluation> results = evaluator->evaluate_together(together, stop, [] { return 1; });
    ASSERT_EQ(results.size(), group.size());
    for (std::size_t n = 0; n < group.size(); ++n) {
      const EvaluationTask& task = tasks[group[n]];
      const auto alone = evaluator_of(in_scenario(study, scenarios_of(study)[task.scenario]));
      EXPECT_EQ(results[n].displacement_m, alone->evaluate(task.body, 1, stop).displacement_m);
    }
  }
  EXPECT_EQ(grouped, (std::multiset<std::size_t>{0, 1, 2, 3, 4}));
  std::vector<const EvaluationTask*> mixed;
  for (const EvaluationTask& task : tasks) mixed.push_back(&task);
  const std::vector<Evaluation> results = evaluator->evaluate_together(mixed, stop, [] { return 1; });
  ASSERT_EQ(results.size(), tasks.size());
  EXPECT_EQ(results[1].displacement_m,
            evaluator_of(in_scenario(study, scenarios_of(study)[1]))->evaluate(tasks[1].body, 1, stop).displacement_m);
}

TEST_F(RobustStudy, RefusesWhatVoxelsDoNotHave) {
  const auto refusal = [&](const std::string& text) {
    return tests::message_of([&] { (void)tests::read_walking_study(folder_ / "study.toml", text); });
  };
  EXPECT_NE(refusal(std::string(voxel_study) + "[robust]\nloss_factors = [0.1]\n")
                .find("belongs to evaluation.model = \"finite_elements\" or \"both\""),
            std::string::npos);
  EXPECT_NE(refusal("preset = \"paper\"\n[robust]\nquantile = 0\n").find("needs body.levels = [1]"), std::string::npos);
  EXPECT_NE(refusal(std::string(voxel_study) + "[robust]\n[check_dt]\n").find("cannot be combined with [check_dt]"),
            std::string::npos);
}

}  // namespace
}  // namespace menger::evolution
