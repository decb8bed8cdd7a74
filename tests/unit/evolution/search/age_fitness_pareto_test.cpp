#include "evolution/search/age_fitness_pareto.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace menger::evolution {
namespace {

using Ids = std::vector<std::uint64_t>;

Ids ids_in_order(const std::vector<PoolMember>& pool, std::size_t survivors) {
  Ids ids;
  for (const std::size_t position : selection_order(pool, survivors)) ids.push_back(pool[position].id);
  return ids;
}

TEST(AgeFitnessPareto, DominanceWantsMoreFitnessAndLessAge) {
  const PoolMember young_good{1, 0, 2.0};
  const PoolMember old_good{2, 5, 2.0};
  const PoolMember young_poor{3, 0, 1.0};
  EXPECT_TRUE(dominates(young_good, old_good));
  EXPECT_TRUE(dominates(young_good, young_poor));
  EXPECT_FALSE(dominates(old_good, young_good));
  EXPECT_FALSE(dominates(young_poor, young_good));
  EXPECT_FALSE(dominates(old_good, young_poor));
  EXPECT_FALSE(dominates(young_poor, old_good));
}

TEST(AgeFitnessPareto, AmongEqualsTheNewerDominates) {
  const PoolMember older{1, 3, 2.0};
  const PoolMember newer{2, 3, 2.0};
  EXPECT_TRUE(dominates(newer, older));
  EXPECT_FALSE(dominates(older, newer));
  EXPECT_FALSE(dominates(older, older));
}

TEST(AgeFitnessPareto, AFailedNewcomerDominatesNoElder) {
  const PoolMember failed{9, 0, std::nullopt};
  const PoolMember elder{1, 40, 0.0};
  EXPECT_FALSE(dominates(failed, elder));
  EXPECT_TRUE(dominates(failed, {1, 40, std::nullopt})) << "other failures do not count as elders";
}

TEST(AgeFitnessPareto, LevelsCountDominators) {
  const std::vector<PoolMember> pool{{1, 2, 3.0}, {2, 1, 2.0}, {3, 2, 2.0}, {4, 3, 1.0}, {5, 0, std::nullopt}};
  EXPECT_EQ(domination_levels(pool, 3), (std::vector<std::size_t>{0, 0, 2, 3, 6}));
}

TEST(AgeFitnessPareto, OrderIsLevelThenFitnessThenAgeThenNewest) {
  const std::vector<PoolMember> pool{{1, 0, 1.0}, {2, 2, 3.0},          {3, 1, 2.0},
                                     {4, 2, 3.0}, {5, 0, std::nullopt}, {6, 0, std::nullopt}};
  EXPECT_EQ(ids_in_order(pool, 3), (Ids{4, 3, 1, 2, 6, 5}));
}

TEST(AgeFitnessPareto, FailuresRankBehindAllThatHaveAFitness) {
  RandomStream random(1, "pools");
  for (int sample = 0; sample < 500; ++sample) {
    std::vector<PoolMember> pool;
    for (std::uint64_t id = 0; id < 31; ++id) {
      pool.push_back(
          {id, static_cast<int>(random.below(10)), random.chance(0.3) ? std::nullopt : std::optional(random.uniform())});
    }
    bool failed_before = false;
    for (const std::size_t position : selection_order(pool, 15)) {
      EXPECT_FALSE(failed_before && pool[position].fitness);
      failed_before = failed_before || !pool[position].fitness;
    }
  }
}

TEST(AgeFitnessPareto, WholeLevelsAreTakenInOrderWithoutADraw) {
  const std::vector<PoolMember> pool{{1, 0, 1.0}, {2, 1, 2.0}, {3, 2, 0.5}, {4, 3, 0.25}};
  RandomStream random(2, "selection");
  const RandomStream before = random;
  EXPECT_EQ(select_survivors(pool, 3, random), (Ids{2, 1, 3}));
  EXPECT_EQ(random, before);
  EXPECT_EQ(select_survivors(pool, 10, random), (Ids{2, 1, 3, 4}));
  EXPECT_EQ(random, before);
}

TEST(AgeFitnessPareto, TheLastLevelIsDrawnAtTheStatedIndices) {
  // Six members that do not dominate each other; their selection order is 6, 5, ..., 1.
  std::vector<PoolMember> pool;
  for (std::uint64_t id = 1; id <= 6; ++id) pool.push_back({id, static_cast<int>(id), static_cast<double>(id)});
  RandomStream random(3, "selection");
  for (int sample = 0; sample < 200; ++sample) {
    RandomStream replay = random;
    const Ids survivors = select_survivors(pool, 3, random);
    Ids expected{6};
    while (expected.size() < 3) {
      const auto index = static_cast<std::uint64_t>(std::floor(std::pow(6.0, replay.uniform())));
      if (std::ranges::find(expected, 6 - index) == expected.end()) expected.push_back(6 - index);
    }
    ASSERT_EQ(survivors, expected);
    ASSERT_EQ(random, replay);
  }
}

TEST(AgeFitnessPareto, TheLastLevelFavoursTheBetterByLogarithms) {
  std::vector<PoolMember> pool;
  for (std::uint64_t id = 1; id <= 5; ++id) pool.push_back({id, static_cast<int>(id), static_cast<double>(id)});
  RandomStream random(4, "selection");
  std::map<std::uint64_t, int> counts;
  constexpr int samples = 40000;
  for (int sample = 0; sample < samples; ++sample) ++counts[select_survivors(pool, 2, random)[1]];
  for (std::uint64_t index = 1; index < 5; ++index) {
    const double probability = std::log(static_cast<double>(index + 1) / static_cast<double>(index)) / std::log(5.0);
    EXPECT_NEAR(counts[5 - index] / static_cast<double>(samples), probability,
                4.0 * std::sqrt(probability * (1.0 - probability) / samples));
  }
}

TEST(AgeFitnessPareto, OrderOfThePoolDoesNotMatter) {
  RandomStream random(5, "pools");
  for (int sample = 0; sample < 200; ++sample) {
    std::vector<PoolMember> pool;
    for (std::uint64_t id = 0; id < 31; ++id) {
      pool.push_back({id, static_cast<int>(random.below(5)), static_cast<double>(random.below(6))});
    }
    RandomStream first(7, "selection");
    RandomStream second(7, "selection");
    const Ids survivors = select_survivors(pool, 15, first);
    random.shuffle(pool);
    EXPECT_EQ(select_survivors(pool, 15, second), survivors);
    EXPECT_EQ(first, second);
    EXPECT_EQ(std::set<std::uint64_t>(survivors.begin(), survivors.end()).size(), 15U);
  }
}

}  // namespace
}  // namespace menger::evolution
