// Survival by niches: which niche a body has, who survives, and which evaluations that needs.

#include "evolution/search/niches.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "evolution/report/evaluated_tasks.h"
#include "evolution/report/niche_table.h"
#include "evolution/search/search.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/search_fixture.h"

namespace menger::evolution {
namespace {

const MapElitesPlan three_cells{};

Niche niche(const std::string& digits) { return niche_of(three_cells, meshes::Polycube::from_digits(3, 3, 3, digits)); }

TEST(NicheOfABody, CountsCellsFeetAndLayers) {
  EXPECT_EQ(niche("111000000000000000000000000"), (Niche{.fewest_cells = 1, .feet = 1, .layers = 1}));
  EXPECT_EQ(niche("111100000000000000000000000"), (Niche{.fewest_cells = 4, .feet = 1, .layers = 1}));
  EXPECT_EQ(niche("101000101111111111000000000"), (Niche{.fewest_cells = 13, .feet = 4, .layers = 2}));
  EXPECT_EQ(niche("100010000111000000111000000"), (Niche{.fewest_cells = 7, .feet = 2, .layers = 3}))
      << "cells that touch along an edge are two feet";
  EXPECT_EQ(niche("000000000101000101111111111"), niche("101000101111111111000000000")) << "the layer it grew in does not matter";
}

class NicheSearch : public tests::SearchFixture {
 protected:
  static SearchPlan plan() {
    SearchPlan plan = tests::small_plan();
    plan.generations = 10;
    plan.offspring.constraints.levels = {1, 2};
    plan.map_elites = MapElitesPlan{};
    return plan;
  }
};

TEST_F(NicheSearch, TheFittestOfEveryNicheSurvives) {
  SearchPlan whole = plan();
  whole.pruning = false;
  const RunArchive archive = searched(whole);
  std::vector<std::size_t> niches;
  for (int generation = 0; generation <= whole.generations; ++generation) {
    std::map<Niche, PoolMember> best;
    std::set<std::uint64_t> survivors;
    for (const PoolMember& member : archive.pool(generation)) {
      if (member.survivor_rank) survivors.insert(member.id);
      if (!member.fitness) continue;
      const auto [place, is_new] = best.try_emplace(niche_of(three_cells, archive.individual(member.id).phenotype.body), member);
      if (!is_new && is_fitter(member, place->second)) place->second = member;
    }
    std::set<std::uint64_t> expected;
    for (const auto& [one, member] : best) expected.insert(member.id);
    EXPECT_EQ(survivors, expected) << generation;
    niches.push_back(best.size());
  }
  EXPECT_GT(niches.back(), niches.front()) << "a search fills niches";
}

TEST_F(NicheSearch, LazyEvaluationSavesSomeAndChangesNoSurvivor) {
  SearchPlan lazy = plan();
  const RunArchive archive = searched(lazy, "lazy");
  lazy.pruning = false;
  const RunArchive whole = searched(lazy, "whole");
  std::uint64_t saved = 0;
  for (int generation = 0; generation <= lazy.generations; ++generation) {
    EXPECT_EQ(archive.survivors(generation), whole.survivors(generation)) << generation;
    for (const PoolMember& member : archive.pool(generation)) saved += member.knowledge == Knowledge::bounded ? 1 : 0;
  }
  EXPECT_GT(saved, 0U) << "bodies that cannot beat the elite of their niche at one level need no other";
}

TEST_F(NicheSearch, IsTheSameForAnyThreadsAndAfterStops) {
  expect_the_same_for_any_threads(plan());
  expect_the_same_after_stops(plan(), {.stride = 5, .spared = 1, .threads = 2});
}

TEST_F(NicheSearch, ItsEvaluationsAreFoundAgainAndItsNichesListed) {
  const SearchPlan plan = NicheSearch::plan();
  const RunArchive archive = searched(plan);
  const RunView run{.archive = &archive, .plan = plan, .physics = evaluator_.physics()};
  for (int generation = 0; generation <= plan.generations; ++generation)
    EXPECT_EQ(evaluated_tasks(run, generation).size(), archive.generation(generation).evaluations) << generation;
  const std::string table = niche_table(run).text();
  EXPECT_EQ(table.find("fewest_cells,feet,layers,individual"), 0U) << table;
}

TEST(NicheSelection, WithoutAnyFitnessTheNewestSurvive) {
  SearchPlan plan = tests::small_plan();
  plan.survivors = 2;
  plan.map_elites = MapElitesPlan{};
  Selection selection(plan);
  std::vector<PoolMember> pool;
  for (std::uint64_t id = 0; id < 3; ++id) {
    Phenotype phenotype;
    phenotype.body = meshes::full_cube(3);
    selection.add(id, phenotype);
    pool.push_back({.id = id, .fitness = {}, .knowledge = Knowledge::failed});
  }
  RandomStream random(1, "selection");
  EXPECT_EQ(selection.select(pool, random), (std::vector<std::uint64_t>{2, 1}));
}

}  // namespace
}  // namespace menger::evolution
