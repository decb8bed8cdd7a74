#include "evolution/search/screening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/text/content_hash.h"
#include "tests/support/search_fixture.h"

namespace menger::evolution {
namespace {

using tests::small_plan;

std::vector<ScoredTwice> pairs(const std::vector<double>& surrogate, const std::vector<double>& score) {
  std::vector<ScoredTwice> all;
  for (std::size_t n = 0; n < surrogate.size(); ++n) all.push_back({surrogate[n], score[n], 1.0});
  return all;
}

TEST(ScreeningCorrelation, IsSpearmans) {
  EXPECT_DOUBLE_EQ(rank_correlation(pairs({1, 2, 3, 4}, {1, 4, 9, 16})).value(), 1.0);
  EXPECT_DOUBLE_EQ(rank_correlation(pairs({1, 2, 3, 4}, {4, 3, 2, 1})).value(), -1.0);
  EXPECT_DOUBLE_EQ(rank_correlation(pairs({1, 2, 3, 4, 5}, {2, 1, 4, 3, 5})).value(), 0.8);
  EXPECT_NEAR(rank_correlation(pairs({1, 2, 2, 3}, {1, 2, 3, 4})).value(), 4.5 / std::sqrt(4.5 * 5.0), 1e-12) << "equal ones";
  EXPECT_FALSE(rank_correlation(pairs({1}, {1})));
  EXPECT_FALSE(rank_correlation(pairs({1, 1, 1}, {1, 2, 3})));
}

TEST(ScreeningCorrelation, IsNothingIfOneSideIsAllEqualWhateverTheWeights) {
  RandomStream random(1, "test");
  for (int n = 0; n < 100; ++n) {
    std::vector<ScoredTwice> robots = pairs({1, 1, 1, 1, 1}, {1, 2, 3, 4, 5});
    for (ScoredTwice& robot : robots) robot.weight = 1.0 / (0.1 + random.uniform());
    EXPECT_FALSE(rank_correlation(robots)) << n;
    for (ScoredTwice& robot : robots) std::swap(robot.surrogate, robot.score);
    EXPECT_FALSE(rank_correlation(robots)) << n;
  }
}

TEST(ScreeningCorrelation, ARobotCountsAsOftenAsItsWeightSays) {
  std::vector<ScoredTwice> weighted = pairs({1, 2, 3, 4}, {3, 1, 2, 4});
  weighted[1].weight = 3.0;
  const std::vector<ScoredTwice> repeated = pairs({1, 2, 2, 2, 3, 4}, {3, 1, 1, 1, 2, 4});
  EXPECT_NEAR(rank_correlation(weighted).value(), rank_correlation(repeated).value(), 1e-12);
}

TEST(ScreeningCorrelation, DrawnOnesCorrectWhatScreeningLeavesOut) {
  // Robots of which the upper half passes and of the lower half each fifth is drawn. Among those that pass, ranks say nothing.
  RandomStream random(3, "test");
  std::vector<ScoredTwice> all;
  std::vector<ScoredTwice> seen;
  std::vector<ScoredTwice> unweighted;
  for (int n = 0; n < 4000; ++n) {
    const double surrogate = random.uniform();
    const double score = surrogate + 2.0 * random.uniform();
    all.push_back({surrogate, score, 1.0});
    const bool passes = surrogate > 0.5;
    if (!passes && random.uniform() >= 0.2) continue;
    seen.push_back({surrogate, score, passes ? 1.0 : 5.0});
    unweighted.push_back({surrogate, score, 1.0});
  }
  const double truth = rank_correlation(all).value();
  EXPECT_NEAR(rank_correlation(seen).value(), truth, 0.04);
  EXPECT_LT(rank_correlation(unweighted).value(), truth - 0.05) << "without weights it is too low";
}

TEST(ScreeningShare, FallsWithTheCorrelationAndIsWholeWithoutAny) {
  const ScreeningPlan plan{.least_share = 0.2, .drawn_share = 0.15};
  std::vector<double> up(200);
  std::vector<double> noise(200);
  RandomStream random(1, "test");
  for (std::size_t n = 0; n < up.size(); ++n) {
    up[n] = static_cast<double>(n);
    noise[n] = random.uniform();
  }
  const auto share = [&](double part) {
    std::vector<double> score;
    for (std::size_t n = 0; n < up.size(); ++n) score.push_back(part * up[n] / 200.0 + (1.0 - part) * noise[n]);
    return passing_share(pairs(up, score), plan);
  };
  EXPECT_NEAR(share(1.0), 0.2, 1e-3);
  EXPECT_LT(share(0.5), share(0.3));
  EXPECT_LT(share(0.3), 1.0);
  EXPECT_GT(share(0.0), 0.9);
  std::vector<double> down(up.rbegin(), up.rend());
  EXPECT_EQ(passing_share(pairs(up, down), plan), 1.0) << "an opposite order is no reason to trust either";
  EXPECT_EQ(passing_share({}, plan), 1.0);
  EXPECT_EQ(passing_share(pairs({1, 2, 3, 4}, {1, 2, 3, 4}), plan), 1.0) << "four robots say too little";
}

/// Searches that a coarse fake evaluator screens.
class ScreenedSearch : public tests::SearchFixture {
 protected:
  [[nodiscard]] static SearchPlan plan() {
    SearchPlan plan = small_plan(5);
    plan.offspring.constraints.levels = {1};
    plan.generations = 8;
    plan.mutants = 10;
    plan.screening = ScreeningPlan{.least_share = 0.2, .drawn_share = 0.2};
    return plan;
  }

  io::RunStatus run(const std::string& name, const SearchPlan& plan, const SearchOptions& options = {}) {
    RunArchive archive = open(name);
    return run_search(plan, evaluator_, archive, options, nullptr, &surrogate_);
  }

  /// Displacements are tenths of body lengths; that keeps most of their order.
  test_support::FakeEvaluator surrogate_{{.failing = 0.05, .coarse = true, .cell_edge_m = 0.01, .before_result = {}}};
};

TEST_F(ScreenedSearch, LeavesOutWhatTheSurrogateRanksLow) {
  std::vector<ScreeningRound> rounds;
  SearchOptions options;
  options.screened = [&](const ScreeningRound& round) { rounds.push_back(round); };
  ASSERT_EQ(run("run", plan(), options), io::RunStatus::completed);
  ASSERT_EQ(rounds.size(), 9U);
  EXPECT_EQ(rounds[0].share, 1.0) << "nothing is known yet";
  EXPECT_EQ(rounds[0].count(Screened::left_out), 0U);
  EXPECT_LT(rounds.back().share, 0.9);
  const RunArchive archive = open("run");
  std::size_t left_out = 0;
  std::size_t drawn = 0;
  const std::string physics = io::content_hash(evaluator_.physics());
  for (const ScreenedIndividual& one : archive.screened_individuals()) {
    const std::vector<PoolMember> pool = archive.pool(one.generation);
    const auto member = std::ranges::find(pool, one.id, &PoolMember::id);
    ASSERT_NE(member, pool.end());
    EXPECT_EQ(member->knowledge == Knowledge::screened, one.outcome == Screened::left_out);
    if (one.outcome == Screened::left_out) {
      ++left_out;
      EXPECT_FALSE(member->fitness);
      EXPECT_FALSE(member->survivor_rank);
    } else {
      const auto found = archive.evaluation({design_hash(archive.individual(one.id).phenotype, 1), 1, physics});
      EXPECT_EQ(member->fitness.has_value(), found && found->result.displacement_m.has_value());
    }
    drawn += one.outcome == Screened::drawn ? 1U : 0U;
    EXPECT_EQ(one.probability, one.outcome == Screened::passed ? 1.0 : 0.2);
  }
  EXPECT_GT(left_out, 10U);
  EXPECT_GT(drawn, 0U);
}

// A body that fell or failed in the first half of its walk has no score of it; the second half could not give it one.
TEST_F(ScreenedSearch, BodiesWithoutAScoreOfTheirFirstHalfGoNoFurther) {
  SearchPlan halves = plan();
  halves.screening->by = Screener::half_walks;
  ASSERT_EQ(run("halves", halves), io::RunStatus::completed);
  ASSERT_EQ(run("surrogate", plan()), io::RunStatus::completed);
  const auto without_score = [&](const std::string& name) {
    const RunArchive archive = open(name);
    std::map<Screened, std::size_t> counts;
    for (const ScreenedIndividual& one : archive.screened_individuals())
      if (!one.surrogate) ++counts[one.outcome];
    return counts;
  };
  const auto of_halves = without_score("halves");
  ASSERT_TRUE(of_halves.contains(Screened::left_out));
  EXPECT_EQ(of_halves.size(), 1U);
  const auto of_surrogate = without_score("surrogate");
  ASSERT_TRUE(of_surrogate.contains(Screened::passed)) << "what voxels cannot evaluate, finite elements may";
  EXPECT_EQ(of_surrogate.size(), 1U);
}

TEST_F(ScreenedSearch, IsTheSameForAnyThreadsAndAfterStops) {
  std::size_t commits = 0;
  SearchOptions counting;
  counting.after_commit = [&](std::size_t count) { commits = count; };
  ASSERT_EQ(run("whole", plan(), counting), io::RunStatus::completed);
  const std::string expected = test_support::archive_content(file("whole"));
  for (const int threads : {2, 8}) {
    SearchOptions options;
    options.threads = threads;
    ASSERT_EQ(run("threads_" + std::to_string(threads), plan(), options), io::RunStatus::completed);
    EXPECT_EQ(test_support::archive_content(file("threads_" + std::to_string(threads))), expected);
  }
  for (std::size_t last = 1; last < commits; last += 4) {
    const std::string name = "stopped_" + std::to_string(last);
    std::atomic<bool> stop{false};
    SearchOptions options;
    options.stop = &stop;
    options.after_commit = [&](std::size_t count) { stop = count >= last; };
    ASSERT_EQ(run(name, plan(), options), io::RunStatus::stopped) << last;
    ASSERT_EQ(run(name, plan()), io::RunStatus::completed);
    EXPECT_EQ(test_support::archive_content(file(name)), expected) << "stopped after commit " << last;
  }
}

TEST_F(ScreenedSearch, ResultsOfAnInterruptedGenerationDoNotChangeItsShare) {
  const SearchPlan plan = ScreenedSearch::plan();
  RunArchive archive = open("run");
  RandomStream random(plan.seed, "test");
  std::vector<Individual> born;
  std::vector<ScreenedIndividual> screened;
  std::vector<PoolMember> pool;
  for (std::uint64_t id = 0; id < 40; ++id) {
    Offspring one = random_offspring(plan.offspring, random);
    born.push_back({id, 0, std::nullopt, 0, std::move(one.genome), std::move(one.phenotype)});
    screened.push_back({.id = id, .generation = 0, .surrogate = static_cast<double>(id)});
    pool.push_back({.id = id, .age = 0, .fitness = {}, .knowledge = Knowledge::bounded});
  }
  archive.add_generation({}, born, pool, screened);
  const std::string physics = io::content_hash(evaluator_.physics());
  std::set<std::string> known;
  for (const Individual& one : born) {  // pruned at first, and asked for again by generation 1, which was interrupted
    const std::string design = design_hash(one.phenotype, 1);
    if (!known.insert(design).second) continue;
    Evaluation result;
    result.status = io::RunStatus::completed;
    result.displacement_m = {0.001 * static_cast<double>(one.id), 0.0, 0.0};
    archive.add_evaluation({design, 1, physics}, {1, result});
  }
  std::size_t commits = 0;
  const Individual newcomer = {40, 1, std::nullopt, 0, born[0].genome, born[0].phenotype};
  const std::vector<const Individual*> candidates{&newcomer};
  const auto round = Screening(plan, surrogate_, evaluator_.physics(), archive).screen(1, candidates, {}, &commits);
  ASSERT_TRUE(round);
  EXPECT_FALSE(round->correlation);
  EXPECT_EQ(round->share, 1.0);
}

/// A screened search in which some bodies fall apart and duplicates are culled.
class CullingScreenedSearch : public ScreenedSearch {
 protected:
  [[nodiscard]] static SearchPlan culling_plan() {
    SearchPlan plan = ScreenedSearch::plan();
    plan.offspring.constraints.levels = {2};
    plan.offspring.constraints.disconnected = DisconnectedPolicy::penalise;
    plan.duplicates = DuplicatePolicy::culled;
    plan.generations = 12;
    plan.newcomers = 4;
    plan.screening = ScreeningPlan{.least_share = 0.2, .drawn_share = 0.1};
    return plan;
  }
};

TEST_F(CullingScreenedSearch, GivesNoPlaceToBodiesThatAreNeverEvaluated) {
  const SearchPlan plan = culling_plan();
  std::vector<ScreeningRound> rounds;
  SearchOptions options;
  options.screened = [&](const ScreeningRound& round) { rounds.push_back(round); };
  ASSERT_EQ(run("run", plan, options), io::RunStatus::completed);
  const RunArchive archive = open("run");
  std::size_t penalised = 0;
  std::size_t culled = 0;
  std::set<std::string> known;     // designs that were not left out in an earlier generation
  std::set<std::string> left_out;  // those that were left out
  std::size_t back = 0;
  for (const ScreeningRound& round : rounds) {
    std::map<std::uint64_t, Knowledge> knowledge;
    for (const PoolMember& member : archive.pool(round.generation)) {
      knowledge[member.id] = member.knowledge;
      if (archive.individual(member.id).generation != round.generation) continue;
      penalised += member.knowledge == Knowledge::penalised ? 1U : 0U;
      culled += member.knowledge == Knowledge::duplicate ? 1U : 0U;
      if (member.knowledge == Knowledge::duplicate) {
        const std::string design = design_hash(archive.individual(member.id).phenotype, 2);
        const auto passes = [&](const ScreenedIndividual& one) {
          return one.outcome != Screened::left_out && design_hash(archive.individual(one.id).phenotype, 2) == design;
        };
        EXPECT_TRUE(known.contains(design) || std::ranges::any_of(round.individuals, passes))
            << "a body that was only left out has no duplicates: individual " << member.id;
      }
    }
    std::map<std::string, Screened> outcomes;
    std::set<std::string> passed;
    for (const ScreenedIndividual& one : round.individuals) {
      EXPECT_NE(knowledge.at(one.id), Knowledge::penalised);
      const std::string design = design_hash(archive.individual(one.id).phenotype, 2);
      EXPECT_FALSE(known.contains(design)) << "a duplicate that is culled needs no screening";
      const auto [twin, is_first] = outcomes.try_emplace(design, one.outcome);
      EXPECT_EQ(one.outcome, twin->second) << "twins have one outcome";
      if (one.outcome == Screened::passed && one.surrogate) passed.insert(design);
      back += one.outcome != Screened::left_out && left_out.contains(design) ? 1U : 0U;
    }
    std::size_t screened = 0;
    for (const auto& [design, outcome] : outcomes) {
      const auto has_score = [&, design = design](const ScreenedIndividual& one) {
        return one.surrogate && design_hash(archive.individual(one.id).phenotype, 2) == design;
      };
      screened += std::ranges::any_of(round.individuals, has_score) ? 1U : 0U;
      (outcome == Screened::left_out ? left_out : known).insert(design);
    }
    EXPECT_EQ(passed.size(), static_cast<std::size_t>(std::ceil(round.share * static_cast<double>(screened))))
        << "generation " << round.generation;
  }
  EXPECT_GT(penalised, 0U);
  EXPECT_GT(culled, 0U);
  EXPECT_GT(left_out.size(), 10U);
  RecordProperty("left_out_that_came_back", static_cast<int>(back));
}

TEST_F(CullingScreenedSearch, IsTheSameAfterStops) {
  const SearchPlan plan = culling_plan();
  std::size_t commits = 0;
  SearchOptions counting;
  counting.after_commit = [&](std::size_t count) { commits = count; };
  ASSERT_EQ(run("whole", plan, counting), io::RunStatus::completed);
  const std::string expected = test_support::archive_content(file("whole"));
  for (std::size_t last = 1; last < commits; last += 7) {
    const std::string name = "stopped_" + std::to_string(last);
    std::atomic<bool> stop{false};
    SearchOptions options;
    options.stop = &stop;
    options.after_commit = [&](std::size_t count) { stop = count >= last; };
    ASSERT_EQ(run(name, plan, options), io::RunStatus::stopped) << last;
    ASSERT_EQ(run(name, plan), io::RunStatus::completed);
    EXPECT_EQ(test_support::archive_content(file(name)), expected) << "stopped after commit " << last;
  }
}

}  // namespace
}  // namespace menger::evolution
