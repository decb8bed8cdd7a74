#include "evolution/search/lazy_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include "evolution/search/age_fitness_pareto.h"

namespace menger::evolution {
namespace {

constexpr std::size_t levels = 3;
using Ids = std::vector<std::uint64_t>;

/// An individual and the results that each of its evaluations would give.
struct Truth {
  PoolMember known;  ///< with the fitness of full evaluation
  std::array<std::optional<double>, levels> results{};
  std::size_t evaluated = 0;  ///< evaluations that were made before the selection

  static Truth of(std::uint64_t id, int age, const std::array<std::optional<double>, levels>& results,
                  std::size_t evaluated = 0) {
    Truth truth{{.id = id, .age = age, .fitness = {}}, results, evaluated};
    if (std::ranges::all_of(results, [](const auto& result) { return result.has_value(); }))
      truth.known.fitness = **std::ranges::min_element(results);
    return truth;
  }

  /// Returns the individual as it is known after the first `count` evaluations. A failure decides it.
  [[nodiscard]] PoolMember after(std::size_t count) const {
    PoolMember partly{.id = known.id, .age = known.age, .fitness = {}, .knowledge = Knowledge::bounded};
    for (std::size_t level = 0; level < count; ++level) {
      if (!results.at(level)) {
        partly.knowledge = Knowledge::failed;
        return partly;
      }
      partly.fitness_bound = std::min(*results.at(level), partly.fitness_bound.value_or(*results.at(level)));
    }
    if (count == levels) {
      partly.knowledge = Knowledge::evaluated;
      partly.fitness = known.fitness;
    }
    return partly;
  }
};

/// Returns an individual whose fitness is not known yet. @param bound upper bound of the fitness, if anything was evaluated
PoolMember bounded(std::uint64_t id, int age, std::optional<double> bound = std::nullopt) {
  return {.id = id, .age = age, .fitness = {}, .knowledge = Knowledge::bounded, .fitness_bound = bound};
}

/// An evaluation: id and level.
using Runs = std::set<std::pair<std::uint64_t, std::size_t>>;
using Policy = std::function<Ids(const SelectionOutlook&)>;

Ids run_as_told(const SelectionOutlook& seen) { return seen.run_now; }

struct LazyResult {
  Ids survivors;
  Runs runs;
};

/// Makes the evaluations that the policy chooses from the outlook until selection is certain, then selects.
LazyResult select_lazily(const std::vector<Truth>& truths, std::size_t survivors, const Policy& policy, RandomStream& random) {
  LazyResult result;
  std::vector<std::size_t> counts;
  std::vector<PoolMember> pool;
  for (const Truth& truth : truths) {
    counts.push_back(truth.evaluated);
    pool.push_back(truth.after(truth.evaluated));
  }
  for (;;) {
    const SelectionOutlook seen = outlook(pool, survivors);
    if (seen.certain()) break;
    const Ids picked = policy(seen);
    EXPECT_FALSE(picked.empty());
    for (const std::uint64_t id : picked) {
      const auto found = std::ranges::find(pool, id, &PoolMember::id);
      const auto position = static_cast<std::size_t>(found - pool.begin());
      EXPECT_FALSE(found->is_decided());
      EXPECT_TRUE(result.runs.emplace(id, counts[position]).second);
      *found = truths[position].after(++counts[position]);
    }
    if (picked.empty()) break;
  }
  result.survivors = select_survivors(pool, survivors, random);
  return result;
}

Ids select_fully(const std::vector<Truth>& truths, std::size_t survivors, RandomStream& random) {
  std::vector<PoolMember> pool;
  pool.reserve(truths.size());
  for (const Truth& truth : truths) pool.push_back(truth.known);
  return select_survivors(pool, survivors, random);
}

/// Returns a random pool: old and new members, various ages, ties (coarse results) and failures, in any order.
std::vector<Truth> random_pool(RandomStream& random) {
  const std::size_t size = 1 + random.below(40);
  const std::size_t grades = 2 + random.below(60);
  const std::size_t ages = 1 + random.below(8);
  const double failures = random.below(3) == 0 ? 0.5 * random.uniform() : 0.02;
  const double elders = random.uniform();
  std::vector<Truth> pool;
  for (std::uint64_t id = 0; id < size; ++id) {
    std::array<std::optional<double>, levels> results;
    for (auto& result : results) {
      if (!random.chance(failures)) result = static_cast<double>(random.below(grades));
    }
    pool.push_back(
        Truth::of(id, static_cast<int>(random.below(ages)), results, random.chance(elders) ? levels : random.below(levels + 1)));
  }
  random.shuffle(pool);
  return pool;
}

/// Expects that the survivors and draws of lazy selection are those of full evaluation, in `samples` random pools.
void expect_as_fully_evaluated(int samples, RandomStream& random, const Policy& policy) {
  for (int sample = 0; sample < samples; ++sample) {
    const std::vector<Truth> truths = random_pool(random);
    const std::size_t survivors = 1 + random.below(20);
    RandomStream full(static_cast<std::uint64_t>(sample), "selection");
    RandomStream lazy = full;
    const Ids expected = select_fully(truths, survivors, full);
    ASSERT_EQ(select_lazily(truths, survivors, policy, lazy).survivors, expected) << "pool " << sample;
    ASSERT_EQ(lazy, full) << "pool " << sample;
  }
}

/// Returns a policy that draws one of the blocking evaluations at random.
Policy any_blocking(RandomStream& choice) {
  return [&choice](const SelectionOutlook& seen) { return Ids{seen.blocking[choice.below(seen.blocking.size())]}; };
}

TEST(LazySelection, GivesTheSurvivorsAndTheDrawsOfFullEvaluation) {
  RandomStream random(1, "pools");
  expect_as_fully_evaluated(20000, random, run_as_told);
}

TEST(LazySelection, AnyOrderOfBlockingOnesLeadsToTheSameSurvivors) {
  RandomStream random(2, "pools");
  RandomStream choice(2, "choice");
  expect_as_fully_evaluated(3000, random, any_blocking(choice));
}

TEST(LazySelection, FirstEvaluationsApartNoOtherOrderSavesAnEvaluation) {
  RandomStream random(3, "pools");
  RandomStream choice(3, "choice");
  std::size_t saved_over_any = 0;
  for (int sample = 0; sample < 3000; ++sample) {
    const std::vector<Truth> truths = random_pool(random);
    const std::size_t survivors = 1 + random.below(20);
    RandomStream draws(1, "selection");
    const Runs told = select_lazily(truths, survivors, run_as_told, draws).runs;
    const Runs any = select_lazily(truths, survivors, any_blocking(choice), draws).runs;
    for (const auto& [id, level] : told) ASSERT_TRUE(level == 0 || any.contains({id, level})) << "pool " << sample;
    saved_over_any += any.size() > told.size() ? 1U : 0U;
  }
  EXPECT_GT(saved_over_any, 0U);
}

TEST(LazySelection, CertaintyIsNotClaimedTooEarly) {
  // When selection is certain, the survivors must stay the same whatever the unknown results turn out to be.
  RandomStream random(4, "pools");
  int changed_truths = 0;
  for (int sample = 0; sample < 3000; ++sample) {
    std::vector<Truth> truths = random_pool(random);
    const std::size_t survivors = 1 + random.below(20);
    RandomStream lazy(1, "selection");
    const LazyResult result = select_lazily(truths, survivors, run_as_told, lazy);
    for (Truth& truth : truths) {
      std::array<std::optional<double>, levels> results = truth.results;
      for (std::size_t level = 0; level < levels; ++level) {
        if (level < truth.evaluated || result.runs.contains({truth.known.id, level})) continue;
        results.at(level) = random.chance(0.3) ? std::nullopt : std::optional(static_cast<double>(random.below(80)));
        ++changed_truths;
      }
      truth = Truth::of(truth.known.id, truth.known.age, results, truth.evaluated);
    }
    RandomStream full(1, "selection");
    ASSERT_EQ(select_fully(truths, survivors, full), result.survivors) << "pool " << sample;
    ASSERT_EQ(full, lazy);
  }
  EXPECT_GT(changed_truths, 3000);
}

TEST(LazySelection, AHopelessNewcomerIsNotEvaluatedFurther) {
  std::vector<PoolMember> pool;
  for (std::uint64_t id = 0; id < 3; ++id) pool.push_back({.id = id, .age = 4, .fitness = 5.0 + static_cast<double>(id)});
  pool.push_back(bounded(3, 4, 1.0));
  EXPECT_TRUE(outlook(pool, 3).certain());
  pool.back().fitness_bound = 6.5;
  EXPECT_EQ(outlook(pool, 3).blocking, (Ids{3}));
  pool.back().fitness_bound = 1.0;
  pool.back().age = 3;
  EXPECT_EQ(outlook(pool, 3).blocking, (Ids{3})) << "a younger one is dominated by none of them";
}

TEST(LazySelection, OfTwoNewcomersTheMorePromisingRunsFirst) {
  const std::vector<PoolMember> pool{{.id = 0, .age = 4, .fitness = 5.0}, bounded(1, 4, 9.0), bounded(2, 4, 8.0)};
  const SelectionOutlook seen = outlook(pool, 1);
  EXPECT_EQ(seen.blocking, (Ids{1, 2}));
  EXPECT_EQ(seen.run_now, (Ids{1})) << "should 1 reach 8, 2 cannot survive";
}

TEST(LazySelection, UntouchedBlockingOnesRunAtOnce) {
  const std::vector<PoolMember> pool{bounded(0, 1), bounded(1, 1), bounded(2, 1), bounded(3, 1)};
  EXPECT_EQ(outlook(pool, 2).run_now, (Ids{3, 2, 1, 0}));
}

TEST(LazySelection, AnEmptyPoolIsCertain) { EXPECT_TRUE(outlook({}, 15).certain()); }

/// A search of the usual size with artificial results: children are near their parents, there is one newcomer, and results
/// differ between levels.
struct Landscape {
  RandomStream random{5, "landscape"};
  std::uint64_t next_id = 0;

  std::array<std::optional<double>, levels> results_around(double quality) {
    std::array<std::optional<double>, levels> results;
    const bool fails = random.chance(0.02);
    for (auto& result : results) result = std::max(0.0, quality + random.normal(0.0, 0.15));
    if (fails) results.back() = std::nullopt;
    return results;
  }
  Truth born() { return Truth::of(next_id++, 0, results_around(0.3 * random.uniform())); }
  Truth child(const Truth& parent) {
    return Truth::of(next_id++, parent.known.age, results_around(parent.known.fitness.value_or(0.0) + random.normal(0.0, 0.2)));
  }
};

TEST(LazySelection, SavesManyDearEvaluationsInASearchOfTheUsualSize) {
  constexpr std::size_t survivors = 15;
  constexpr int generations = 100;
  Landscape landscape;
  RandomStream selection(5, "selection");
  std::vector<Truth> population;
  for (std::size_t count = 0; count < survivors; ++count) population.push_back(landscape.born());
  for (Truth& truth : population) truth.evaluated = levels;
  std::array<std::size_t, levels> runs{};
  std::size_t newcomers = 0;
  for (int generation = 0; generation < generations; ++generation) {
    for (Truth& truth : population) ++truth.known.age;
    std::vector<Truth> pool = population;
    for (const Truth& parent : population) pool.push_back(landscape.child(parent));
    pool.push_back(landscape.born());
    newcomers += pool.size() - population.size();
    const LazyResult result = select_lazily(pool, survivors, run_as_told, selection);
    for (const auto& [id, level] : result.runs) ++runs.at(level);
    std::erase_if(
        pool, [&](const Truth& truth) { return std::ranges::find(result.survivors, truth.known.id) == result.survivors.end(); });
    population = pool;
    for (Truth& truth : population) truth.evaluated = levels;
  }
  RecordProperty("newcomers", static_cast<int>(newcomers));
  RecordProperty("level_1_runs", static_cast<int>(runs[0]));
  RecordProperty("level_2_runs", static_cast<int>(runs[1]));
  RecordProperty("level_3_runs", static_cast<int>(runs[2]));
  EXPECT_EQ(newcomers, 1600U);
  EXPECT_LT(runs[2], newcomers * 3 / 5) << "of the dearest evaluations at least two fifths are saved";
  EXPECT_LT(runs[1], newcomers * 4 / 5);
  EXPECT_GT(runs[2], newcomers / 20) << "a landscape on which nothing is ever evaluated would prove nothing";
}

}  // namespace
}  // namespace menger::evolution
