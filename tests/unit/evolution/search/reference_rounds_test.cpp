// Rounds of reference evaluations in a search.

#include "evolution/search/reference_rounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "evolution/report/reference_table.h"
#include "evolution/search/search.h"
#include "io/text/content_hash.h"
#include "tests/support/search_fixture.h"

namespace menger::evolution {
namespace {

using test_support::archive_content;
using test_support::FakeReferenceEvaluator;

SearchPlan reference_plan() {
  SearchPlan plan;
  plan.seed = 5;
  plan.generations = 9;
  plan.survivors = 10;  // enough that two are always without a reference evaluation
  plan.mutants = 10;
  plan.stand = true;
  plan.offspring.constraints.levels = {1};
  plan.reference = ReferencePlan{.every = 2, .designs = 2, .budget_element_steps = 1e9, .protocol = "fake"};
  return plan;
}

class ReferenceSearch : public tests::SearchFixture {
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
            .distinction = reference_.distinction(),
            .voxels_per_cell = 1};
  }
};

TEST_F(ReferenceSearch, EveryFewGenerationsTheBestDistinctSurvivorsAreEvaluated) {
  const SearchPlan plan = reference_plan();
  std::vector<int> rounds;
  SearchOptions options;
  options.round_done = [&](const ReferenceRound& round, const Discrepancy&) { rounds.push_back(round.generation); };
  ASSERT_EQ(search("run", plan, options), io::RunStatus::completed);
  EXPECT_EQ(rounds, (std::vector{2, 4, 6, 8}));
  const RunArchive archive = open("run");
  std::set<std::string> forms;
  std::map<int, std::size_t> evaluated;
  for (const ReferenceEvaluation& one : archive.reference_evaluations()) {
    EXPECT_TRUE(forms.insert(one.form).second) << "a robot was evaluated twice";
    EXPECT_EQ(one.place, evaluated[one.generation]++);
    const std::vector<PoolMember> before = archive.pool(one.generation - 1);
    const auto member = std::ranges::find(before, one.individual, &PoolMember::id);
    ASSERT_NE(member, before.end());
    EXPECT_TRUE(member->survivor_rank);
    const Phenotype phenotype = archive.individual(one.individual).phenotype;
    EXPECT_EQ(one.form, robot_form(phenotype.body, reference_.distinction()));
    EXPECT_EQ(one.surrogate, surrogate_score(plan, archive, phenotype));
    // A robot of n cells moves n mm; its body is 30 mm long.
    EXPECT_NEAR(one.score.value(), static_cast<double>(phenotype.body.count()) / 30.0, 1e-12);
    EXPECT_EQ(one.element_steps, 10 * phenotype.body.count());
    // No better robot without a reference evaluation was left out.
    for (const PoolMember& other : before) {
      if (!other.survivor_rank || !other.fitness || !member->fitness || *other.fitness <= *member->fitness) continue;
      EXPECT_TRUE(forms.count(robot_form(archive.individual(other.id).phenotype.body, reference_.distinction())) > 0);
    }
  }
  EXPECT_EQ(evaluated, (std::map<int, std::size_t>{{2, 2}, {4, 2}, {6, 2}, {8, 2}}));
  EXPECT_EQ(archive.reevaluations().size(), 8U);
}

TEST_F(ReferenceSearch, TheFitnessIsTheReferencesScoreOrTheCorrectedOneOfTheSurrogate) {
  const SearchPlan plan = reference_plan();
  const RunArchive archive = searched(plan);
  std::size_t evaluated = 0;
  std::size_t corrected = 0;
  for (int generation = 0; generation <= plan.generations; ++generation) {
    std::vector<ReferenceEvaluation> known = archive.reference_evaluations();
    std::erase_if(known, [&](const ReferenceEvaluation& one) { return one.generation > generation; });
    const CorrectedFitness fitness(reference_.distinction(), known);
    for (const PoolMember& member : archive.pool(generation)) {
      if (member.knowledge == Knowledge::bounded) continue;
      const Phenotype phenotype = archive.individual(member.id).phenotype;
      const auto surrogate = surrogate_score(plan, archive, phenotype);
      ASSERT_EQ(member.fitness.has_value(), surrogate.has_value());
      if (!surrogate) continue;
      if (const ReferenceEvaluation* found = fitness.reference_evaluation_of(phenotype.body)) {
        EXPECT_EQ(member.fitness, found->score);
        ++evaluated;
      } else {
        const double expected =
            fitness.discrepancy().corrected(robot_poses(phenotype.body, reference_.distinction()), *surrogate);
        EXPECT_EQ(member.fitness, expected);
        if (generation < 2) {
          EXPECT_EQ(member.fitness, surrogate) << "nothing was learnt yet";
        }
        if (*member.fitness != *surrogate) ++corrected;
      }
    }
  }
  EXPECT_GT(evaluated, 10U);
  EXPECT_GT(corrected, 10U);
}

TEST_F(ReferenceSearch, PruningChangesNoPopulation) {
  SearchPlan plan = reference_plan();
  const RunArchive pruned = searched(plan, "pruned");
  plan.pruning = false;
  const RunArchive whole = searched(plan, "whole");
  const auto survivors = [](const RunArchive& archive) {
    std::map<std::size_t, std::pair<std::uint64_t, std::optional<double>>> ranks;
    for (const PoolMember& member : archive.pool(9))
      if (member.survivor_rank) ranks[*member.survivor_rank] = {member.id, member.fitness};
    return ranks;
  };
  EXPECT_EQ(survivors(pruned), survivors(whole));
  EXPECT_EQ(pruned.generation(9).selection_generator, whole.generation(9).selection_generator);
}

TEST_F(ReferenceSearch, OneThatTheReferenceFailsHasNoFitnessAndStopsNobody) {
  reference_ =
      FakeReferenceEvaluator({.failing = 0.3, .crashing = 0.3, .fewest_cells = 0, .time_factor = 1.0, .before_results = {}});
  SearchPlan plan = reference_plan();
  plan.generations = 15;
  const RunArchive archive = searched(plan);
  std::set<std::string> failed;
  std::size_t without_result = 0;
  for (const ReferenceEvaluation& one : archive.reference_evaluations()) {
    if (one.score) continue;
    failed.insert(one.form);
    without_result += one.found.has_result ? 0U : 1U;
    EXPECT_EQ(one.found.result.reason, one.found.has_result ? "too fast" : "exit code 1");
  }
  EXPECT_GT(without_result, 0U);
  EXPECT_GT(failed.size(), without_result);
  std::size_t seen = 0;
  for (const PoolMember& member : archive.pool(15)) {
    if (failed.count(robot_form(archive.individual(member.id).phenotype.body, reference_.distinction())) == 0) continue;
    ++seen;
    EXPECT_FALSE(member.fitness);
    EXPECT_EQ(member.knowledge, Knowledge::failed);
  }
  EXPECT_EQ(archive.last_generation(), 15);
  EXPECT_GT(seen + failed.size(), 0U);
}

TEST_F(ReferenceSearch, TheBudgetIsNotPassedAfterTheFirstRoundAndTheSearchGoesOn) {
  SearchPlan plan = reference_plan();
  plan.generations = 13;
  plan.reference->budget_element_steps = 700.0;  // a robot costs 10 per cell: the budget is enough for a few robots
  std::vector<bool> exhausted;
  SearchOptions options;
  options.round_done = [&](const ReferenceRound& round, const Discrepancy&) {
    exhausted.push_back(round.is_exhausted);
    EXPECT_LE(round.element_steps, 700U);
  };
  ASSERT_EQ(search("run", plan, options), io::RunStatus::completed);
  EXPECT_FALSE(exhausted.front());
  EXPECT_TRUE(exhausted.back());
  const RunArchive archive = open("run");
  const std::vector<ReferenceEvaluation> evaluations = archive.reference_evaluations();
  std::uint64_t dearest = 0;
  for (const ReferenceEvaluation& one : evaluations) dearest = std::max(dearest, one.element_steps);
  EXPECT_GT(element_steps_of(evaluations) + dearest, 700U) << "another would have fitted";
  EXPECT_EQ(archive.last_generation(), 13);

  plan.reference->budget_element_steps = 0.0;
  EXPECT_TRUE(searched(plan, "none").reference_evaluations().empty());
}

TEST_F(ReferenceSearch, WithoutABudgetItIsTheSearchWithoutAReference) {
  SearchPlan plan = reference_plan();
  plan.reference->budget_element_steps = 0.0;
  ASSERT_EQ(search("evaluated", plan), io::RunStatus::completed);
  plan.reference.reset();
  ASSERT_EQ(search("plain", plan), io::RunStatus::completed);
  EXPECT_EQ(archive_content(file("evaluated")), archive_content(file("plain")));
}

TEST_F(ReferenceSearch, RobotsThatCannotBeEvaluatedKeepTheCorrectedScore) {
  reference_ =
      FakeReferenceEvaluator({.failing = 0.0, .crashing = 0.0, .fewest_cells = 15, .time_factor = 1.0, .before_results = {}});
  const RunArchive archive = searched(reference_plan());
  EXPECT_FALSE(archive.reference_evaluations().empty());
  for (const ReferenceEvaluation& one : archive.reference_evaluations())
    EXPECT_GE(archive.individual(one.individual).phenotype.body.count(), 15U);
}

TEST_F(ReferenceSearch, ScoresAreOverTheSameTime) {
  reference_ =
      FakeReferenceEvaluator({.failing = 0.0, .crashing = 0.0, .fewest_cells = 0, .time_factor = 4.0, .before_results = {}});
  const ReferenceEvaluation one = searched(reference_plan()).reference_evaluations().front();
  EXPECT_NEAR(one.score.value(), 4.0 * one.found.result.displacement_m.value()[0] / 0.03, 1e-12);
}

TEST_F(ReferenceSearch, TheArchiveDoesNotDependOnThreads) { expect_the_same_for_any_threads(reference_plan()); }

TEST_F(ReferenceSearch, StoppedAtAnyCommitGoesOnToTheSameArchive) {
  SearchPlan plan = reference_plan();
  plan.generations = 5;
  // The last commit but one is the last evaluation. After it there is nothing left to stop.
  expect_the_same_after_stops(plan, {.stride = 1, .spared = 1, .rounds = 2});
}

TEST_F(ReferenceSearch, StoppedWhileTheReferenceWorksItAddsNothing) {
  std::atomic<bool> stop{false};
  reference_ = FakeReferenceEvaluator(
      {.failing = 0.0, .crashing = 0.0, .fewest_cells = 0, .time_factor = 1.0, .before_results = [&](std::uint64_t) {
         stop = true;
       }});
  SearchOptions options;
  options.stop = &stop;
  ASSERT_EQ(search("run", reference_plan(), options), io::RunStatus::stopped);
  EXPECT_TRUE(open("run").reference_evaluations().empty());
  EXPECT_EQ(open("run").last_generation(), 1);
}

TEST_F(ReferenceSearch, TablesShowBothFitnessesAndWhatTheyCost) {
  const SearchPlan plan = reference_plan();
  const RunArchive archive = searched(plan);
  const RunView run = view(archive, plan);
  const std::string generations = generations_table(run).text();
  EXPECT_NE(generations.find("champion_surrogate_fitness_body_lengths,champion_reference_fitness_body_lengths"),
            std::string::npos);
  EXPECT_EQ(reference_table(run).row_count(), 8U);
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
  EXPECT_EQ(element_steps, element_steps_of(archive.reference_evaluations()));
  // The fake evaluator makes a thousand steps for every body, also for one that fails.
  std::set<std::string> evaluated;
  std::uint64_t expected = 0;
  for (std::uint64_t id = 0; id < archive.next_id(); ++id) {
    const Phenotype phenotype = as_simulated(plan, archive.individual(id).phenotype);
    const EvaluationKey key{design_hash(phenotype, 1), 1, io::content_hash(evaluator_.physics())};
    if (archive.evaluation(key) && evaluated.insert(key.design_hash).second) expected += 1000 * phenotype.body.count();
  }
  EXPECT_EQ(voxel_steps, expected);
  const auto best = best_by_reference(archive);
  ASSERT_TRUE(best);
  for (const ReferenceEvaluation& one : archive.reference_evaluations()) EXPECT_LE(one.score, best->score);
  EXPECT_NE(reference_summary(run).find("8 reference evaluations"), std::string::npos);

  SearchPlan plain = plan;
  plain.reference.reset();
  EXPECT_EQ(generations_table(view(archive, plain)).text().find("evaluated"), std::string::npos);
}

}  // namespace
}  // namespace menger::evolution
