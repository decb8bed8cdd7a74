// Robots in several scenarios: their scores, and searches that end walks of robots that cannot survive any more.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "evolution/evaluation/scenario_evaluator.h"
#include "evolution/report/evaluated_tasks.h"
#include "evolution/search/known_score.h"
#include "evolution/search/search.h"
#include "io/text/content_hash.h"
#include "tests/support/search_fixture.h"

namespace menger::evolution {
namespace {

using test_support::archive_content;
using test_support::FakeEvaluator;

SearchPlan scenario_plan(std::size_t scenarios, double quantile = 0.0) {
  SearchPlan plan = tests::small_plan();
  plan.generations = 12;
  plan.offspring.constraints.levels = {1};
  plan.scenarios = scenarios;
  plan.quantile = quantile;
  return plan;
}

/// A result at level 1 with this score; nothing: one that failed.
Evaluation result_of(const SearchPlan& plan, std::optional<double> score) {
  Evaluation result;
  result.status = score ? io::RunStatus::completed : io::RunStatus::diverged;
  if (score) result.displacement_m = {*score * 3.0 * plan.cell_edge_m, 0.0, 0.0};
  return result;
}

KnownResults known(const SearchPlan& plan, const std::vector<std::optional<double>>& scores) {
  KnownResults results;
  for (std::size_t n = 0; n < scores.size(); ++n) results[{1, n}] = result_of(plan, scores[n]);
  return results;
}

TEST(KnownScore, TheWorstScenarioIsTheScore) {
  const SearchPlan plan = scenario_plan(3);
  EXPECT_FALSE(known_score(plan, {}).at_most);
  EXPECT_NEAR(*known_score(plan, known(plan, {0.5})).at_most, 0.5, 1e-15) << "further results can only lower it";
  EXPECT_NEAR(*known_score(plan, known(plan, {0.5, 0.2, 0.7})).at_most, 0.2, 1e-15);
  EXPECT_EQ(deciding_scenario(plan, 1, known(plan, {0.5, 0.2, 0.7})), 1U);
  EXPECT_FALSE(deciding_scenario(plan, 1, known(plan, {0.5, 0.2}))) << "the third may be worse";
  EXPECT_TRUE(known_score(plan, known(plan, {0.5, std::nullopt})).is_failed);
  EXPECT_EQ(next_stage(plan, known(plan, {0.5, 0.2})), (EvaluationStage{1, 2}));
  EXPECT_FALSE(next_stage(plan, known(plan, {0.5, 0.2, 0.7})));
}

TEST(KnownScore, AQuantileLeavesTheWorstScenariosOut) {
  const SearchPlan plan = scenario_plan(5, 0.4);
  ASSERT_EQ(plan.left_out_scenarios(), 2U) << "0.4 times 5, in spite of rounding";
  EXPECT_FALSE(known_score(plan, known(plan, {0.5, 0.2})).at_most) << "these two may be those that do not count";
  EXPECT_NEAR(*known_score(plan, known(plan, {0.5, 0.2, 0.7})).at_most, 0.7, 1e-15);
  EXPECT_NEAR(*known_score(plan, known(plan, {0.5, 0.2, 0.7, 0.1, 0.9})).at_most, 0.5, 1e-15);
  const KnownResults two_failed = known(plan, {0.5, std::nullopt, 0.7, std::nullopt, 0.9});
  EXPECT_FALSE(known_score(plan, two_failed).is_failed);
  EXPECT_NEAR(*known_score(plan, two_failed).at_most, 0.5, 1e-15);
  EXPECT_EQ(deciding_scenario(plan, 1, two_failed), 0U);
  EXPECT_TRUE(known_score(plan, known(plan, {std::nullopt, std::nullopt, std::nullopt})).is_failed);
  EXPECT_EQ(scenario_plan(6, 0.0).left_out_scenarios(), 0U);
  EXPECT_EQ(scenario_plan(6, 0.99).left_out_scenarios(), 5U) << "the best one always counts";
  const SearchPlan almost_all = scenario_plan(4, std::nextafter(1.0, 0.0));
  EXPECT_EQ(almost_all.left_out_scenarios(), 3U) << "also where the share of the others rounds to 1";
  EXPECT_NEAR(known_score(almost_all, known(almost_all, {0.5, 0.2, 0.7, 0.1})).at_most.value_or(0.0), 0.7, 1e-15);
}

TEST(KnownScore, OfAllResultsIsNeverAboveTheBoundOfSome) {
  for (const double quantile : {0.0, 0.34, 0.5, 0.8}) {
    const SearchPlan plan = scenario_plan(6, quantile);
    RandomStream random(3, "scores");
    for (int trial = 0; trial < 200; ++trial) {
      std::vector<std::optional<double>> scores(6);
      for (auto& score : scores)
        if (random.uniform() > 0.1) score = random.uniform();
      const KnownScore all = known_score(plan, known(plan, scores));
      for (std::size_t count = 1; count < scores.size(); ++count) {
        const KnownScore some = known_score(plan, known(plan, {scores.begin(), scores.begin() + static_cast<long>(count)}));
        if (some.is_failed) {
          EXPECT_TRUE(all.is_failed);
        } else if (some.at_most && all.at_most) {
          EXPECT_LE(*all.at_most, *some.at_most);
        }
      }
    }
  }
}

class ScenarioSearch : public tests::SearchFixture {
 protected:
  static std::unique_ptr<ScenarioEvaluator> scenarios(std::size_t count) {
    std::vector<std::unique_ptr<DesignEvaluator>> all;
    for (std::size_t n = 0; n < count; ++n)
      all.push_back(std::make_unique<FakeEvaluator>(
          FakeEvaluator::Options{.cell_edge_m = 0.01, .scenario = "scenario " + std::to_string(n), .before_result = {}}));
    return std::make_unique<ScenarioEvaluator>(std::move(all));
  }

  io::RunStatus search_scenarios(const std::string& name, const SearchPlan& plan, const SearchOptions& options = {}) const {
    RunArchive archive = open(name);
    return run_search(plan, *scenarios(plan.scenarios), archive, options);
  }

  [[nodiscard]] static RunView view(const RunArchive& archive, const SearchPlan& plan) {
    const auto evaluator = scenarios(plan.scenarios);
    return {.archive = &archive, .plan = plan, .physics = evaluator->physics(), .scenario_physics = evaluator->scenarios()};
  }
};

TEST_F(ScenarioSearch, ARobotHasNoDisplacementThatDecidesBeforeAllScenariosAreKnown) {
  const SearchPlan plan = scenario_plan(4);
  ASSERT_EQ(search_scenarios("run", plan), io::RunStatus::completed);
  const RunArchive archive = open("run");
  std::size_t undecided = 0;
  for (const PoolMember& member : archive.pool(plan.generations)) {
    const Individual individual = archive.individual(member.id);
    const KnownResults results = archived_results(view(archive, plan), individual.phenotype);
    const DesignSummary summary = summarise_design(view(archive, plan), individual, member);
    if (member.fitness) {
      EXPECT_NEAR(summary.body_lengths.at(1), *member.fitness, 1e-15);
    } else if (results.size() < 4) {
      if (!results.empty()) ++undecided;
      EXPECT_TRUE(summary.body_lengths.empty()) << results.size() << " of 4 scenarios are known";
    }
  }
  EXPECT_GT(undecided, 0U);
}

TEST_F(ScenarioSearch, FitnessIsTheScoreOverAllScenarios) {
  SearchPlan plan = scenario_plan(4);
  plan.pruning = false;
  ASSERT_EQ(search_scenarios("run", plan), io::RunStatus::completed);
  const RunArchive archive = open("run");
  std::size_t evaluated = 0;
  for (int generation = 0; generation <= plan.generations; ++generation) {
    for (const PoolMember& member : archive.pool(generation)) {
      const KnownResults results = archived_results(view(archive, plan), archive.individual(member.id).phenotype);
      ASSERT_EQ(results.size(), 4U);
      const KnownScore score = known_score(plan, results);
      EXPECT_EQ(score.is_failed, member.knowledge == Knowledge::failed);
      if (!member.fitness) continue;
      ++evaluated;
      EXPECT_EQ(score.at_most, member.fitness);
      for (const auto& [stage, result] : results) EXPECT_LE(*member.fitness, level_score(plan, *result.displacement_m, 1));
    }
  }
  EXPECT_GT(evaluated, 50U);
}

TEST_F(ScenarioSearch, RacingSavesWalksAndChangesNoSurvivor) {
  for (const double quantile : {0.0, 0.4}) {
    SearchPlan plan = scenario_plan(6, quantile);
    const std::string name = "quantile_" + std::to_string(plan.left_out_scenarios());
    ASSERT_EQ(search_scenarios(name + "_raced", plan), io::RunStatus::completed);
    plan.pruning = false;
    ASSERT_EQ(search_scenarios(name + "_whole", plan), io::RunStatus::completed);
    const RunArchive raced = open(name + "_raced");
    const RunArchive whole = open(name + "_whole");
    std::uint64_t made = 0;
    std::uint64_t pruned = 0;
    std::uint64_t made_of_whole = 0;
    for (int generation = 0; generation <= plan.generations; ++generation) {
      EXPECT_EQ(raced.survivors(generation), whole.survivors(generation)) << generation;
      made += raced.generation(generation).evaluations;
      pruned += raced.generation(generation).pruned;
      made_of_whole += whole.generation(generation).evaluations;
    }
    // With two that do not count, no walk can end before the third scenario.
    EXPECT_LT(made, plan.left_out_scenarios() == 0 ? made_of_whole * 3 / 4 : made_of_whole * 9 / 10) << "quantile " << quantile;
    EXPECT_GT(pruned, 0U);
  }
}

TEST_F(ScenarioSearch, IsTheSameForAnyThreadsAndAfterStops) {
  const SearchPlan plan = scenario_plan(3);
  std::size_t commits = 0;
  SearchOptions counting;
  counting.after_commit = [&](std::size_t count) { commits = count; };
  ASSERT_EQ(search_scenarios("whole", plan, counting), io::RunStatus::completed);
  const std::string expected = archive_content(file("whole"));
  for (const int threads : {2, 8}) {
    SearchOptions options;
    options.threads = threads;
    const std::string name = "threads_" + std::to_string(threads);
    ASSERT_EQ(search_scenarios(name, plan, options), io::RunStatus::completed);
    EXPECT_EQ(archive_content(file(name)), expected) << threads << " threads";
  }
  for (std::size_t last = 1; last + 1 < commits; last += 7) {
    const std::string name = "stopped_" + std::to_string(last);
    std::atomic<bool> stop{false};
    SearchOptions options;
    options.threads = 2;
    options.stop = &stop;
    options.after_commit = [&](std::size_t count) { stop = count >= last; };
    ASSERT_EQ(search_scenarios(name, plan, options), io::RunStatus::stopped) << last;
    ASSERT_EQ(search_scenarios(name, plan), io::RunStatus::completed);
    EXPECT_EQ(archive_content(file(name)), expected) << "stopped after commit " << last;
  }
}

TEST_F(ScenarioSearch, ItsWalksAreFoundAgainInTheOrderInWhichTheyWereAskedFor) {
  const SearchPlan plan = scenario_plan(3);
  ASSERT_EQ(search_scenarios("run", plan), io::RunStatus::completed);
  const RunArchive archive = open("run");
  const RunView run = view(archive, plan);
  for (int generation = 0; generation <= plan.generations; ++generation) {
    const std::vector<EvaluatedTask> tasks = evaluated_tasks(run, generation);
    EXPECT_EQ(tasks.size(), archive.generation(generation).evaluations) << generation;
    EXPECT_TRUE(std::ranges::all_of(tasks, [](const EvaluatedTask& task) { return task.scenario < 3; }));
  }
}

TEST_F(ScenarioSearch, AnArchiveNamesItsScenarios) {
  RunArchive archive = open("run");
  EXPECT_TRUE(archive.scenarios().empty());
  const std::vector<ArchivedScenario> scenarios{{"hash of one", "friction = 1"}, {"hash of two", "friction = 2"}};
  archive.set_scenarios(scenarios);
  archive.set_scenarios(scenarios);
  EXPECT_EQ(archive.scenarios(), scenarios);
}

}  // namespace
}  // namespace menger::evolution
