#include "evolution/reevaluation/reevaluation_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace menger::evolution {
namespace {

using meshes::Polycube;

Polycube body_of(const std::string& digits) { return Polycube::from_digits(3, 3, 3, digits); }

/// Returns a body from its layers, the lowest first.
Polycube body_of_layers(const std::string& first, const std::string& second = "000000000",
                        const std::string& third = "000000000") {
  return body_of(first + second + third);
}

FitDesign design(std::uint64_t individual, const Polycube& body, double fitness) {
  return {.individual = individual,
          .phenotype = {.body = body, .arrangement = {}, .arrangement_of_arrangements = {}},
          .fitness = fitness};
}

/// Returns bars and plates that are all different robots, the best first.
std::vector<FitDesign> different_designs() {
  const std::vector<Polycube> bodies{
      body_of_layers("100000000"), body_of_layers("110000000"), body_of_layers("111000000"), body_of_layers("110100000"),
      body_of_layers("111100000"), body_of_layers("111010000"), body_of_layers("111110000"), body_of_layers("111111000"),
      body_of_layers("111111100"), body_of_layers("111111010"), body_of_layers("111111110"), body_of_layers("111111111"),
  };
  std::vector<FitDesign> designs;
  for (const Polycube& body : bodies) {
    const std::size_t n = designs.size();
    designs.push_back(design(100 + n, body, 1.0 - 0.01 * static_cast<double>(n)));
  }
  return designs;
}

std::string nothing_against(const Polycube&) { return ""; }

TEST(ReevaluationSelection, TakesTheBestDistinctOnesOnce) {
  std::vector<FitDesign> designs = different_designs();
  designs.insert(designs.begin() + 1, design(7, body_of_layers("000000001"), 0.995));  // the first robot in another place
  const DesignSelection selection = choose_designs(designs, {.top = 3, .distinction = {.materials = false}}, nothing_against);
  EXPECT_EQ(selection.distinct, 12U);
  ASSERT_EQ(selection.chosen.size(), 3U);
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_EQ(selection.chosen[n].individual, 100 + n);
    EXPECT_EQ(selection.chosen[n].rank, n + 1);
    EXPECT_TRUE(selection.chosen[n].is_top);
  }
  EXPECT_TRUE(selection.refused.empty());
}

TEST(ReevaluationSelection, WhatCannotBeEvaluatedIsNamedAndLeftOut) {
  const auto obstacle = [](const Polycube& body) { return body.count() == 2 ? std::string("too short") : std::string(); };
  const DesignSelection selection = choose_designs(different_designs(), {.top = 2}, obstacle);
  ASSERT_EQ(selection.chosen.size(), 2U);
  EXPECT_EQ(selection.chosen[1].rank, 3U);
  ASSERT_EQ(selection.refused.size(), 1U);
  EXPECT_EQ(selection.refused[0].rank, 2U);
  EXPECT_EQ(selection.refused[0].reason, "too short");
  EXPECT_TRUE(choose_designs(different_designs(), {.top = 2}, [](const Polycube&) { return "no"; }).chosen.empty());
}

TEST(ReevaluationSelection, TheSampleHasOneOfEveryStratum) {
  std::set<std::size_t> drawn;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const SelectionOptions options{.top = 3, .sample = 3, .seed = seed};
    const DesignSelection selection = choose_designs(different_designs(), options, nothing_against);
    ASSERT_EQ(selection.chosen.size(), 6U);
    for (std::size_t stratum = 0; stratum < 3; ++stratum) {
      const ChosenDesign& chosen = selection.chosen[3 + stratum];
      EXPECT_FALSE(chosen.is_top);
      EXPECT_EQ((chosen.rank - 4) / 3, stratum) << "ranks 4 ... 12 in three strata";
      drawn.insert(chosen.rank);
    }
    const DesignSelection again = choose_designs(different_designs(), options, nothing_against);
    for (std::size_t n = 0; n < 6; ++n) EXPECT_EQ(again.chosen[n].rank, selection.chosen[n].rank);
  }
  EXPECT_EQ(drawn.size(), 9U) << "any of a stratum may be drawn";
}

TEST(ReevaluationSelection, ASampleAsLargeAsTheRestIsTheRest) {
  const DesignSelection selection = choose_designs(different_designs(), {.top = 2, .sample = 99}, nothing_against);
  EXPECT_EQ(selection.chosen.size(), 12U);
  EXPECT_EQ(std::ranges::count(selection.chosen, true, &ChosenDesign::is_top), 2);
}

}  // namespace
}  // namespace menger::evolution
