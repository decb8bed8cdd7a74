// The part of a dearer judge in a search.

#include "evolution/search/search_judging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "evolution/report/judgement_table.h"
#include "evolution/search/search.h"
#include "io/text/content_hash.h"
#include "tests/support/search_fixture.h"

namespace menger::evolution {
namespace {

using test_support::archive_content;
using test_support::FakeJudge;

SearchPlan judged_plan() {
  SearchPlan plan;
  plan.seed = 5;
  plan.generations = 9;
  plan.survivors = 10;  // enough that two are always left to be judged
  plan.mutants = 10;
  plan.stand = true;
  plan.offspring.constraints.levels = {1};
  plan.judging = JudgingPlan{.every = 2, .designs = 2, .budget_element_steps = 1e9, .protocol = "fake"};
  return plan;
}

class JudgedSearch : public tests::SearchFixture {
 protected:
  [[nodiscard]] std::optional<double> surrogate_score(const SearchPlan& plan, const RunArchive& archive,
                                                      const Phenotype& phenotype) const {
    const auto found =
        archive.evaluation({design_hash(as_simulated(plan, phenotype), 1), 1, io::content_hash(evaluator_.physics())});
    if (!found || !found->result.displacement_m) return std::nullopt;
    return level_score(plan, *found->result.displacement_m, 1);
  }

  [[nodiscard]] RunView view(const RunArchive& archive, const SearchPlan& plan) const {
    return {.archive = &archive,
            .plan = plan,
            .physics = evaluator_.physics(),
            .distinction = judge_.distinction(),
            .voxels_per_cell = 1};
  }
};

TEST_F(JudgedSearch, EveryFewGenerationsTheBestDistinctSurvivorsAreJudged) {
  const SearchPlan plan = judged_plan();
  std::vector<int> rounds;
  SearchOptions options;
  options.judged = [&](const JudgingRound& round, const Discrepancy&) { rounds.push_back(round.generation); };
  ASSERT_EQ(search("run", plan, options), io::RunStatus::completed);
  EXPECT_EQ(rounds, (std::vector{2, 4, 6, 8}));
  const RunArchive archive = open("run");
  std::set<std::string> forms;
  std::map<int, std::size_t> judged;
  for (const Judgement& one : archive.judgements()) {
    EXPECT_TRUE(forms.insert(one.form).second) << "a robot was judged twice";
    EXPECT_EQ(one.place, judged[one.generation]++);
    const std::vector<Contender> before = archive.contenders(one.generation - 1);
    const auto contender = std::ranges::find(before, one.individual, &Contender::id);
    ASSERT_NE(contender, before.end());
    EXPECT_TRUE(contender->survivor_rank);
    const Phenotype phenotype = archive.individual(one.individual).phenotype;
    EXPECT_EQ(one.form, robot_form(phenotype.body, judge_.distinction()));
    EXPECT_EQ(one.surrogate, surrogate_score(plan, archive, phenotype));
    // n cells go n mm of a body of 30 mm.
    EXPECT_NEAR(one.score.value(), static_cast<double>(phenotype.body.count()) / 30.0, 1e-12);
    EXPECT_EQ(one.element_steps, 10 * phenotype.body.count());
    // Nobody better that was not judged before stayed behind.
    for (const Contender& other : before) {
      if (!other.survivor_rank || !other.fitness || !contender->fitness || *other.fitness <= *contender->fitness) continue;
      EXPECT_TRUE(forms.count(robot_form(archive.individual(other.id).phenotype.body, judge_.distinction())) > 0);
    }
  }
  EXPECT_EQ(judged, (std::map<int, std::size_t>{{2, 2}, {4, 2}, {6, 2}, {8, 2}}));
  EXPECT_EQ(archive.reevaluations().size(), 8U);
}

TEST_F(JudgedSearch, TheFitnessIsTheJudgesScoreOrTheCorrectedOneOfTheSurrogate) {
  const SearchPlan plan = judged_plan();
  const RunArchive archive = searched(plan);
  std::size_t judged = 0;
  std::size_t corrected = 0;
  for (int generation = 0; generation <= plan.generations; ++generation) {
    std::vector<Judgement> known = archive.judgements();
    std::erase_if(known, [&](const Judgement& one) { return one.generation > generation; });
    const CorrectedFitness fitness(judge_.distinction(), known);
    for (const Contender& contender : archive.contenders(generation)) {
      if (contender.knowledge == Knowledge::bounded) continue;
      const Phenotype phenotype = archive.individual(contender.id).phenotype;
      const auto surrogate = surrogate_score(plan, archive, phenotype);
      ASSERT_EQ(contender.fitness.has_value(), surrogate.has_value());
      if (!surrogate) continue;
      if (const Judgement* found = fitness.judgement_of(phenotype.body)) {
        EXPECT_EQ(contender.fitness, found->score);
        ++judged;
      } else {
        const double expected = fitness.discrepancy().corrected(robot_poses(phenotype.body, judge_.distinction()), *surrogate);
        EXPECT_EQ(contender.fitness, expected);
        if (generation < 2) {
          EXPECT_EQ(contender.fitness, surrogate) << "nothing was learnt yet";
        }
        if (*contender.fitness != *surrogate) ++corrected;
      }
    }
  }
  EXPECT_GT(judged, 10U);
  EXPECT_GT(corrected, 10U);
}

TEST_F(JudgedSearch, PruningChangesNoPopulation) {
  SearchPlan plan = judged_plan();
  const RunArchive pruned = searched(plan, "pruned");
  plan.pruning = false;
  const RunArchive whole = searched(plan, "whole");
  const auto survivors = [](const RunArchive& archive) {
    std::map<std::size_t, std::pair<std::uint64_t, std::optional<double>>> ranks;
    for (const Contender& contender : archive.contenders(9))
      if (contender.survivor_rank) ranks[*contender.survivor_rank] = {contender.id, contender.fitness};
    return ranks;
  };
  EXPECT_EQ(survivors(pruned), survivors(whole));
  EXPECT_EQ(pruned.generation(9).selection_generator, whole.generation(9).selection_generator);
}

TEST_F(JudgedSearch, OneThatTheJudgeFailsHasNoFitnessAndStopsNobody) {
  judge_ = FakeJudge({.failing = 0.3, .crashing = 0.3, .fewest_cells = 0, .time_factor = 1.0, .before_results = {}});
  SearchPlan plan = judged_plan();
  plan.generations = 15;
  const RunArchive archive = searched(plan);
  std::set<std::string> failed;
  std::size_t without_result = 0;
  for (const Judgement& one : archive.judgements()) {
    if (one.score) continue;
    failed.insert(one.form);
    without_result += one.found.has_result ? 0U : 1U;
    EXPECT_EQ(one.found.result.reason, one.found.has_result ? "too fast" : "exit code 1");
  }
  EXPECT_GT(without_result, 0U);
  EXPECT_GT(failed.size(), without_result);
  std::size_t seen = 0;
  for (const Contender& contender : archive.contenders(15)) {
    if (failed.count(robot_form(archive.individual(contender.id).phenotype.body, judge_.distinction())) == 0) continue;
    ++seen;
    EXPECT_FALSE(contender.fitness);
    EXPECT_EQ(contender.knowledge, Knowledge::failed);
  }
  EXPECT_EQ(archive.last_generation(), 15);
  EXPECT_GT(seen + failed.size(), 0U);
}

TEST_F(JudgedSearch, TheBudgetIsNotPassedAfterTheFirstRoundAndTheSearchGoesOn) {
  SearchPlan plan = judged_plan();
  plan.generations = 13;
  plan.judging->budget_element_steps = 700.0;  // of 10 per cell and robot: a few robots
  std::vector<bool> exhausted;
  SearchOptions options;
  options.judged = [&](const JudgingRound& round, const Discrepancy&) {
    exhausted.push_back(round.is_exhausted);
    EXPECT_LE(round.element_steps, 700U);
  };
  ASSERT_EQ(search("run", plan, options), io::RunStatus::completed);
  EXPECT_FALSE(exhausted.front());
  EXPECT_TRUE(exhausted.back());
  const RunArchive archive = open("run");
  const std::vector<Judgement> judgements = archive.judgements();
  std::uint64_t dearest = 0;
  for (const Judgement& one : judgements) dearest = std::max(dearest, one.element_steps);
  EXPECT_GT(element_steps_of(judgements) + dearest, 700U) << "another would have fitted";
  EXPECT_EQ(archive.last_generation(), 13);

  plan.judging->budget_element_steps = 0.0;
  EXPECT_TRUE(searched(plan, "none").judgements().empty());
}

TEST_F(JudgedSearch, WithoutABudgetItIsTheSearchWithoutAJudge) {
  SearchPlan plan = judged_plan();
  plan.judging->budget_element_steps = 0.0;
  ASSERT_EQ(search("judged", plan), io::RunStatus::completed);
  plan.judging.reset();
  ASSERT_EQ(search("plain", plan), io::RunStatus::completed);
  EXPECT_EQ(archive_content(file("judged")), archive_content(file("plain")));
}

TEST_F(JudgedSearch, RobotsThatCannotBeJudgedKeepTheCorrectedScore) {
  judge_ = FakeJudge({.failing = 0.0, .crashing = 0.0, .fewest_cells = 15, .time_factor = 1.0, .before_results = {}});
  const RunArchive archive = searched(judged_plan());
  EXPECT_FALSE(archive.judgements().empty());
  for (const Judgement& one : archive.judgements()) EXPECT_GE(archive.individual(one.individual).phenotype.body.count(), 15U);
}

TEST_F(JudgedSearch, ScoresAreOverTheSameTime) {
  judge_ = FakeJudge({.failing = 0.0, .crashing = 0.0, .fewest_cells = 0, .time_factor = 4.0, .before_results = {}});
  const Judgement one = searched(judged_plan()).judgements().front();
  EXPECT_NEAR(one.score.value(), 4.0 * one.found.result.displacement_m.value()[0] / 0.03, 1e-12);
}

TEST_F(JudgedSearch, TheArchiveDoesNotDependOnThreads) { expect_the_same_for_any_threads(judged_plan()); }

TEST_F(JudgedSearch, StoppedAtAnyCommitGoesOnToTheSameArchive) {
  SearchPlan plan = judged_plan();
  plan.generations = 5;
  // The last but one is the last evaluation, after which nothing remains to be stopped.
  expect_the_same_after_stops(plan, {.stride = 1, .spared = 1, .rounds = 2});
}

TEST_F(JudgedSearch, StoppedWhileTheJudgeWorksItAddsNothing) {
  std::atomic<bool> stop{false};
  judge_ =
      FakeJudge({.failing = 0.0, .crashing = 0.0, .fewest_cells = 0, .time_factor = 1.0, .before_results = [&](std::uint64_t) {
                   stop = true;
                 }});
  SearchOptions options;
  options.stop = &stop;
  ASSERT_EQ(search("run", judged_plan(), options), io::RunStatus::stopped);
  EXPECT_TRUE(open("run").judgements().empty());
  EXPECT_EQ(open("run").last_generation(), 1);
}

TEST_F(JudgedSearch, TablesShowBothFitnessesAndWhatTheyCost) {
  const SearchPlan plan = judged_plan();
  const RunArchive archive = searched(plan);
  const RunView run = view(archive, plan);
  const std::string generations = generations_table(run).text();
  EXPECT_NE(generations.find("champion_surrogate_fitness_body_lengths,champion_judged_fitness_body_lengths"), std::string::npos);
  EXPECT_EQ(judgement_table(run).row_count(), 8U);
  EXPECT_EQ(correction_table(run).row_count(), 4U);
  EXPECT_EQ(cost_table(run).row_count(), 10U);
  std::uint64_t element_steps = 0;
  std::uint64_t voxel_steps = 0;
  for (int generation = 0; generation <= 9; ++generation) {
    const GenerationCost cost = generation_cost(run, generation);
    element_steps += cost.element_steps;
    voxel_steps += cost.voxel_steps;
    if (generation % 2 == 1) {
      EXPECT_EQ(cost.element_steps, 0U);
    }
  }
  EXPECT_EQ(element_steps, element_steps_of(archive.judgements()));
  // The fake evaluator takes a thousand steps whatever the body, one that fails, too.
  std::set<std::string> evaluated;
  std::uint64_t expected = 0;
  for (std::uint64_t id = 0; id < archive.next_id(); ++id) {
    const Phenotype phenotype = as_simulated(plan, archive.individual(id).phenotype);
    const EvaluationKey key{design_hash(phenotype, 1), 1, io::content_hash(evaluator_.physics())};
    if (archive.evaluation(key) && evaluated.insert(key.design_hash).second) expected += 1000 * phenotype.body.count();
  }
  EXPECT_EQ(voxel_steps, expected);
  const auto best = best_judged(archive);
  ASSERT_TRUE(best);
  for (const Judgement& one : archive.judgements()) EXPECT_LE(one.score, best->score);
  EXPECT_NE(judging_text(run).find("8 robots judged"), std::string::npos);

  SearchPlan plain = plan;
  plain.judging.reset();
  EXPECT_EQ(generations_table(view(archive, plain)).text().find("judged"), std::string::npos);
}

}  // namespace
}  // namespace menger::evolution
