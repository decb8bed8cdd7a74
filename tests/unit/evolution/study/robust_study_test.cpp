// Studies whose robots walk in several scenarios.

#include <gtest/gtest.h>

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
    const fem::WalkInput walk = walk_of(one, meshes::Polycube::from_digits(1, 1, 1, "1"));
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
  const std::string message = tests::message_of(
      [&] { (void)tests::read_walking_study(folder_ / "study.toml", "preset = \"paper\"\n[robust]\nquantile = 0\n"); });
  EXPECT_NE(message.find("belongs to evaluation.model = \"finite_elements\" or \"both\""), std::string::npos) << message;
}

}  // namespace
}  // namespace menger::evolution
