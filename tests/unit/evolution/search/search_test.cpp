#include "evolution/search/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "evolution/genome/robot_form.h"
#include "evolution/search/age_fitness_pareto.h"
#include "evolution/search/pool_evaluation.h"
#include "io/text/content_hash.h"
#include "tests/support/search_fixture.h"

namespace menger::evolution {
namespace {

using test_support::archive_content;
using test_support::FakeEvaluator;
using tests::small_plan;

SearchPlan released_plan(std::uint64_t seed = 3) {
  SearchPlan plan = small_plan(seed);
  plan.objective = Objective::squared_metres_per_scale;
  plan.duplicates = DuplicatePolicy::culled;
  plan.offspring.variation = {ActivationSet::released_code, OutputFunction::mutable_};
  plan.offspring.decoder.expression = {Expression::first_consumer_activated, AxisMap::zyx};
  plan.offspring.constraints.disconnected = DisconnectedPolicy::allow;
  return plan;
}

class SearchRun : public tests::SearchFixture {
 protected:
  [[nodiscard]] std::optional<ArchivedEvaluation> result(const RunArchive& archive, const Phenotype& phenotype, int level) const {
    return archive.evaluation({design_hash(phenotype, level), level, io::content_hash(evaluator_.physics())});
  }
};

/// Returns everything that selection decided: the survivors with their order and state, and the random streams.
std::string outcome_of(const RunArchive& archive) {
  std::string text;
  for (int generation = 0; generation <= archive.last_generation().value(); ++generation) {
    std::map<std::size_t, PoolMember> survivors;
    for (const PoolMember& member : archive.pool(generation)) {
      if (member.survivor_rank) survivors[*member.survivor_rank] = member;
    }
    for (const auto& [rank, survivor] : survivors) {
      text += std::to_string(rank) + " " + std::to_string(survivor.id) + " " + std::to_string(survivor.age) + " " +
              (survivor.fitness ? std::to_string(*survivor.fitness) : "none") + "\n";
    }
    const GenerationRecord record = archive.generation(generation);
    text += record.variation_generator + " " + record.selection_generator + "\n";
  }
  return text;
}

std::uint64_t evaluations_of(const RunArchive& archive) {
  std::uint64_t sum = 0;
  for (int generation = 0; generation <= archive.last_generation().value(); ++generation)
    sum += archive.generation(generation).evaluations;
  return sum;
}

TEST_F(SearchRun, EvaluatesGenerationZeroInFullAndKeepsAllOfIt) {
  SearchPlan plan = small_plan();
  plan.generations = 0;
  const RunArchive archive = searched(plan);
  const std::vector<PoolMember> members = archive.pool(0);
  ASSERT_EQ(members.size(), 6U);
  for (const PoolMember& member : members) {
    EXPECT_EQ(member.age, 0);
    EXPECT_EQ(member.survivor_rank, member.id);
    for (const int level : plan.levels()) EXPECT_TRUE(result(archive, archive.individual(member.id).phenotype, level));
  }
  EXPECT_EQ(archive.generation(0).pruned, 0U);
}

TEST_F(SearchRun, EverySurvivorHasOneChildOfItsAgeAndANewcomerJoins) {
  const RunArchive archive = searched(small_plan());
  for (int generation = 1; generation <= 6; ++generation) {
    std::map<std::uint64_t, int> age_before;
    for (const PoolMember& member : archive.pool(generation - 1)) {
      if (member.survivor_rank) age_before[member.id] = member.age;
    }
    const std::vector<PoolMember> pool = archive.pool(generation);
    ASSERT_EQ(pool.size(), 13U);
    std::multiset<std::uint64_t> parents;
    int newcomers = 0;
    for (const PoolMember& member : pool) {
      const Individual individual = archive.individual(member.id);
      if (individual.generation < generation) {
        EXPECT_EQ(member.age, age_before.at(member.id) + 1);
      } else if (individual.parent) {
        parents.insert(*individual.parent);
        EXPECT_EQ(member.age, age_before.at(*individual.parent) + 1);
        EXPECT_EQ(individual.age, member.age);
      } else {
        ++newcomers;
        EXPECT_EQ(member.age, 0);
      }
    }
    EXPECT_EQ(newcomers, 1);
    ASSERT_EQ(parents.size(), 6U);
    for (const auto& [id, age] : age_before) EXPECT_EQ(parents.count(id), 1U);
  }
}

TEST_F(SearchRun, FitnessIsTheLeastScoreAndNoneWithoutAllLevels) {
  for (const SearchPlan& plan : {small_plan(), released_plan()}) {
    const RunArchive archive = searched(plan, plan.duplicates == DuplicatePolicy::culled ? "released" : "paper");
    std::size_t evaluated = 0;
    std::size_t failed = 0;
    for (int generation = 0; generation <= 6; ++generation) {
      for (const PoolMember& member : archive.pool(generation)) {
        const Phenotype phenotype = archive.individual(member.id).phenotype;
        EXPECT_EQ(member.fitness.has_value(), member.knowledge == Knowledge::evaluated);
        if (member.knowledge == Knowledge::evaluated) {
          double least = 1e300;
          for (const int level : plan.levels())
            least = std::min(least, level_score(plan, result(archive, phenotype, level)->result.displacement_m.value(), level));
          EXPECT_EQ(member.fitness, least);
          ++evaluated;
        }
        if (member.knowledge == Knowledge::failed) {
          EXPECT_TRUE(std::ranges::any_of(plan.levels(), [&](int level) {
            const auto found = result(archive, phenotype, level);
            return found && found->result.status == io::RunStatus::diverged;
          }));
          ++failed;
        }
      }
    }
    EXPECT_GT(evaluated, 20U);
    EXPECT_GT(failed, 0U);
  }
}

TEST_F(SearchRun, WithoutPruningSurvivorsAreThoseOfSelectionOnTheWholePool) {
  SearchPlan plan = small_plan();
  plan.pruning = false;
  const RunArchive archive = searched(plan);
  for (int generation = 1; generation <= 6; ++generation) {
    std::vector<PoolMember> pool;
    std::map<std::size_t, std::uint64_t> ranks;
    for (const PoolMember& member : archive.pool(generation)) {
      EXPECT_NE(member.knowledge, Knowledge::bounded);
      pool.push_back({member.id, member.age, member.fitness});
      if (member.survivor_rank) ranks[*member.survivor_rank] = member.id;
    }
    RandomStream random = RandomStream::from_text(archive.generation(generation - 1).selection_generator);
    const std::vector<std::uint64_t> expected = select_survivors(pool, 6, random);
    ASSERT_EQ(ranks.size(), expected.size());
    for (std::size_t rank = 0; rank < expected.size(); ++rank) EXPECT_EQ(ranks[rank], expected[rank]);
    EXPECT_EQ(random.to_text(), archive.generation(generation).selection_generator);
  }
}

TEST_F(SearchRun, PruningChangesNoPopulationAndSavesEvaluations) {
  std::uint64_t lazy = 0;
  std::uint64_t full = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (SearchPlan plan : {small_plan(seed), released_plan(seed)}) {
      const std::string name = std::to_string(seed) + std::string(to_string(plan.duplicates));
      plan.pruning = true;
      const RunArchive pruned = searched(plan, name + "_pruned");
      plan.pruning = false;
      const RunArchive whole = searched(plan, name + "_whole");
      EXPECT_EQ(outcome_of(pruned), outcome_of(whole)) << name;
      lazy += evaluations_of(pruned);
      full += evaluations_of(whole);
    }
  }
  EXPECT_LT(lazy, full * 9 / 10);
}

TEST_F(SearchRun, PruningChangesNoPopulationAmongManyTiesAndFailures) {
  FakeEvaluator::Options options;
  options.failing = 0.3;
  options.coarse = true;
  const FakeEvaluator coarse(options);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SearchPlan plan = small_plan(seed);
    plan.newcomers = 3;
    RunArchive pruned = open(std::to_string(seed) + "_pruned");
    EXPECT_EQ(run_search(plan, coarse, pruned, {}), io::RunStatus::completed);
    plan.pruning = false;
    RunArchive whole = open(std::to_string(seed) + "_whole");
    EXPECT_EQ(run_search(plan, coarse, whole, {}), io::RunStatus::completed);
    EXPECT_EQ(outcome_of(pruned), outcome_of(whole)) << seed;
  }
}

TEST_F(SearchRun, NoSurvivorIsOnlyBounded) {
  const RunArchive archive = searched(small_plan());
  bool any_bounded = false;
  for (int generation = 0; generation <= 6; ++generation) {
    for (const PoolMember& member : archive.pool(generation)) {
      any_bounded = any_bounded || member.knowledge == Knowledge::bounded;
      if (member.survivor_rank) {
        EXPECT_NE(member.knowledge, Knowledge::bounded);
      }
    }
  }
  EXPECT_TRUE(any_bounded) << "nothing was pruned, so nothing is tested";
}

TEST_F(SearchRun, ArchiveDoesNotDependOnThreads) {
  for (const SearchPlan& plan : {small_plan(), released_plan()})
    expect_the_same_for_any_threads(plan, std::string(to_string(plan.duplicates)));
}

TEST_F(SearchRun, AnotherSeedIsAnotherSearch) {
  EXPECT_NE(outcome_of(searched(small_plan(1), "one")), outcome_of(searched(small_plan(2), "two")));
}

TEST_F(SearchRun, StoppedAtAnyCommitGoesOnToTheSameArchive) {
  expect_the_same_after_stops(small_plan(), {.stride = 7, .threads = 2});
}

TEST_F(SearchRun, ALargerGoalContinuesAFinishedSearch) {
  SearchPlan plan = small_plan();
  plan.generations = 2;
  ASSERT_EQ(search("grown", plan), io::RunStatus::completed);
  plan.generations = 6;
  ASSERT_EQ(search("grown", plan), io::RunStatus::completed);
  ASSERT_EQ(search("straight", plan), io::RunStatus::completed);
  EXPECT_EQ(archive_content(file("grown")), archive_content(file("straight")));
}

TEST_F(SearchRun, AFinishedSearchEvaluatesNothingMore) {
  const SearchPlan plan = small_plan();
  ASSERT_EQ(search("run", plan), io::RunStatus::completed);
  const std::uint64_t calls = evaluator_.calls();
  ASSERT_EQ(search("run", plan), io::RunStatus::completed);
  EXPECT_EQ(evaluator_.calls(), calls);
}

TEST_F(SearchRun, NeverEvaluatesADesignTwice) {
  SearchPlan plan = small_plan();
  plan.pruning = false;
  plan.generations = 15;
  const RunArchive archive = searched(plan);
  EXPECT_EQ(evaluations_of(archive), evaluator_.calls());
  std::uint64_t cached = 0;
  for (int generation = 0; generation <= 15; ++generation) cached += archive.generation(generation).cached;
  EXPECT_GT(cached, 0U) << "no duplicates, so nothing is tested";
}

/// Returns new individuals with the phenotype of an earlier one, with their entries in their first pool.
std::vector<std::pair<Individual, PoolMember>> duplicates_in(const RunArchive& archive) {
  std::set<std::string> seen;
  std::vector<std::pair<Individual, PoolMember>> found;
  for (int generation = 0; generation <= archive.last_generation().value(); ++generation) {
    for (const PoolMember& member : archive.pool(generation)) {
      Individual individual = archive.individual(member.id);
      if (individual.generation < generation) continue;
      if (!seen.insert(phenotype_key(individual.phenotype)).second) found.emplace_back(std::move(individual), member);
    }
  }
  return found;
}

TEST_F(SearchRun, DuplicatesTakeTheArchivedResultOrAreCulled) {
  for (SearchPlan plan : {small_plan(), released_plan()}) {
    plan.generations = 15;
    plan.pruning = false;
    const RunArchive archive = searched(plan, std::string(to_string(plan.duplicates)));
    const auto duplicates = duplicates_in(archive);
    ASSERT_FALSE(duplicates.empty());
    for (const auto& [individual, member] : duplicates) {
      if (plan.duplicates == DuplicatePolicy::culled) {
        EXPECT_EQ(member.knowledge, Knowledge::duplicate);
        EXPECT_FALSE(member.fitness);
      } else {
        EXPECT_TRUE(member.knowledge == Knowledge::evaluated || member.knowledge == Knowledge::failed);
      }
    }
  }
}

SearchPlan redrawn_plan() {
  SearchPlan plan = small_plan();
  plan.duplicates = DuplicatePolicy::redrawn;
  return plan;
}

TEST_F(SearchRun, DuplicatesAreRedrawnWhileThereAreOthers) {
  SearchPlan plan = redrawn_plan();
  plan.generations = 15;
  const RunArchive archive = searched(plan);
  EXPECT_TRUE(duplicates_in(archive).empty());
  plan.duplicates = DuplicatePolicy::archived_result;
  EXPECT_FALSE(duplicates_in(searched(plan, "not redrawn")).empty()) << "nothing is tested";
}

TEST_F(SearchRun, ADuplicateThatNoTryChangedTakesTheArchivedResult) {
  SearchPlan plan = redrawn_plan();
  plan.generations = 15;
  plan.pruning = false;
  plan.offspring.largest_tries = 1;
  const auto duplicates = duplicates_in(searched(plan));
  ASSERT_FALSE(duplicates.empty());
  for (const auto& [individual, member] : duplicates)
    EXPECT_TRUE(member.knowledge == Knowledge::evaluated || member.knowledge == Knowledge::failed);
}

TEST_F(SearchRun, RedrawnDuplicatesAreTheSameForAnyThreadsAndStops) {
  expect_the_same_for_any_threads(redrawn_plan());
  expect_the_same_after_stops(redrawn_plan(), {.stride = 7, .threads = 2});
}

TEST_F(SearchRun, WhereBodiesStandALiftedTwinIsRedrawn) {
  SearchPlan plan = redrawn_plan();
  plan.stand = true;
  plan.generations = 20;
  const RunArchive archive = searched(plan);
  std::set<std::string> seen;
  for (std::uint64_t id = 0; id < archive.next_id(); ++id)
    EXPECT_TRUE(seen.insert(phenotype_key(standing(archive.individual(id).phenotype))).second) << id;
}

TEST_F(SearchRun, ADesignAndItsLiftedTwinShareAnEvaluationWhereBodiesStand) {
  SearchPlan plan = small_plan();
  Individual low;
  low.phenotype.body = meshes::Polycube::from_digits(3, 3, 3, "111011000010000000000000000");
  Individual high = low;
  high.id = 1;
  high.phenotype.body = meshes::Polycube::from_digits(3, 3, 3, "000000000111011000010000000");
  for (const bool stand : {true, false}) {
    plan.stand = stand;
    RunArchive archive = open(stand ? "standing" : "grown");
    std::size_t commits = 0;
    const std::uint64_t before = evaluator_.calls();
    const SearchOptions options;
    PoolEvaluation pool(plan, evaluator_, archive, options, 0, &commits);
    pool.add_newcomer(low, false);
    pool.add_newcomer(high, false);
    ASSERT_EQ(pool.evaluate_in_full(), io::RunStatus::completed);
    const std::vector<PoolMember> members = pool.pool();
    ASSERT_TRUE(members[0].fitness) << "this body diverges: take another";
    EXPECT_EQ(members[0].fitness == members[1].fitness, stand);
    EXPECT_EQ(evaluator_.calls() - before, stand ? 3U : 6U) << "at three levels";
    EXPECT_EQ(pool.counts().cached, stand ? 3U : 0U);
  }
}

TEST_F(SearchRun, WhereBodiesStandALiftedTwinIsADuplicate) {
  SearchPlan plan = released_plan();
  plan.stand = true;
  plan.generations = 20;
  plan.pruning = false;
  const RunArchive archive = searched(plan);
  std::set<std::string> seen;
  std::size_t lifted = 0;
  for (std::uint64_t id = 0; id < archive.next_id(); ++id) {
    const Individual individual = archive.individual(id);
    const bool is_new = seen.insert(phenotype_key(standing(individual.phenotype))).second;
    const std::vector<PoolMember> pool = archive.pool(individual.generation);
    const auto member = std::ranges::find(pool, id, &PoolMember::id);
    EXPECT_EQ(member->knowledge == Knowledge::duplicate, !is_new);
    if (standing(individual.phenotype) != individual.phenotype) ++lifted;
  }
  EXPECT_GT(lifted, 0U) << "all bodies stand as they grew, so nothing is tested";
}

TEST_F(SearchRun, PenalisedBodiesHaveNoFitnessAndAreNotSimulated) {
  SearchPlan plan = small_plan();
  plan.offspring.constraints.disconnected = DisconnectedPolicy::penalise;
  plan.survivors = 20;
  const RunArchive archive = searched(plan);
  std::size_t penalised = 0;
  for (const PoolMember& member : archive.pool(0)) {
    const Phenotype phenotype = archive.individual(member.id).phenotype;
    EXPECT_EQ(member.knowledge == Knowledge::penalised, falls_apart(phenotype, plan.offspring.constraints));
    if (member.knowledge != Knowledge::penalised) continue;
    ++penalised;
    EXPECT_FALSE(member.fitness);
    for (const int level : plan.levels()) EXPECT_FALSE(result(archive, phenotype, level));
  }
  EXPECT_GT(penalised, 0U);
}

TEST_F(SearchRun, ArrangedBodiesAreSearchedToo) {
  SearchPlan plan = small_plan();
  plan.offspring.decoder.plan = BodyPlan::nonfractal;
  plan.generations = 2;
  const RunArchive archive = searched(plan);
  EXPECT_TRUE(archive.individual(archive.pool(2).front().id).phenotype.has_arrangements());
}

TEST_F(SearchRun, ArrangedBodiesOfTwoScalesKeepTheirThirdArrayAndAreValidAtTheSecond) {
  SearchPlan plan = small_plan();
  plan.offspring.decoder.plan = BodyPlan::nonfractal_two_scales;
  plan.offspring.constraints.levels = {1, 2};
  plan.offspring.constraints.smallest_arranged_body = 12;
  plan.generations = 6;
  const RunArchive archive = searched(plan);
  for (std::uint64_t id = 0; id < archive.next_id(); ++id) {
    const Phenotype phenotype = archive.individual(id).phenotype;
    EXPECT_EQ(phenotype.arrangement_of_arrangements.digits(), "000000000000010000000000000");
    EXPECT_GE(aggregate_cell_count(phenotype, 2), 12U);
    EXPECT_TRUE(aggregate_is_connected(phenotype, 2));
  }
}

TEST_F(SearchRun, ReportsEveryGenerationAndItsCounts) {
  SearchPlan plan = small_plan();
  std::vector<int> numbers;
  std::size_t requested = 0;
  SearchOptions options;
  options.generation_done = [&](const GenerationRecord& record) {
    numbers.push_back(record.number);
    EXPECT_EQ(record.evaluations, requested);
    // Children and newcomers at three levels each. The first generation is the population alone.
    EXPECT_EQ(record.evaluations + record.cached + record.pruned, (record.number == 0 ? 6U : 7U) * 3U);
  };
  options.progress = [&](const SearchProgress& progress) {
    EXPECT_LE(progress.finished, progress.requested);
    requested = progress.requested;
  };
  ASSERT_EQ(search("run", plan, options), io::RunStatus::completed);
  EXPECT_EQ(numbers, (std::vector{0, 1, 2, 3, 4, 5, 6}));
}

TEST(Objective, BodyLengthsAreOfTheWorkspace) {
  SearchPlan plan;
  EXPECT_DOUBLE_EQ(level_score(plan, {0.03, 0.04, 7.0}, 1), 0.05 / 0.03);
  EXPECT_DOUBLE_EQ(level_score(plan, {0.03, 0.04, 7.0}, 3), 0.05 / 0.27);
}

TEST(Objective, SquaredMetresFollowTheReleasedFormula) {
  SearchPlan plan;
  plan.objective = Objective::squared_metres_per_scale;
  const double factors[] = {3.0, 9.0, 27.0};
  for (int level = 1; level <= 3; ++level) {
    const std::array<double, 3> displacement_m{0.012, -0.034, 0.5};
    const double lengths = body_lengths(displacement_m, level, 0.01);
    EXPECT_NEAR(level_score(plan, displacement_m, level), 1e-4 * factors[level - 1] * lengths * lengths, 1e-18);
  }
}

}  // namespace
}  // namespace menger::evolution
