#include "evolution/search/screening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
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
    return run_search(plan, evaluator_, archive, options, nullptr, nullptr, &surrogate_);
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

}  // namespace
}  // namespace menger::evolution
