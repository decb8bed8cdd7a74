#include "evolution/genome/constraints.h"

#include <gtest/gtest.h>

#include <string>

#include "evolution/genome/random_stream.h"
#include "meshes/design/connectivity.h"
#include "meshes/design/fractal.h"

namespace menger::evolution {
namespace {

using meshes::Polycube;

/// Returns a grid in which every cell is occupied with this probability.
Polycube random_cells(double density, RandomStream& random) {
  std::string digits;
  for (std::size_t cell = 0; cell < basal_cells; ++cell) digits += random.chance(density) ? '1' : '0';
  return Polycube::from_digits(3, 3, 3, digits);
}

/// An S in a plane: its ends in x do not face each other, so that neighbours along x do not touch.
const Phenotype s_body = phenotype_from_key("110011000000000000000000000");
const Phenotype bar_body = phenotype_from_key("111000000000000000000000000");

TEST(Constraints, ReplacementIsEvaluatedAsTheBuiltBody) {
  RandomStream random(1, "replacement");
  int connected = 0;
  constexpr int samples = 3000;
  for (int sample = 0; sample < samples; ++sample) {
    const Polycube mask = random_cells(0.2 + 0.7 * random.uniform(), random);
    const Polycube block = random_cells(0.2 + 0.7 * random.uniform(), random);
    const bool expected = meshes::is_connected(meshes::replace_cells(mask, block));
    ASSERT_EQ(replacement_is_connected(mask, block), expected) << mask.digits() << " of " << block.digits();
    connected += expected ? 1 : 0;
  }
  EXPECT_GT(connected, samples / 10);
  EXPECT_LT(connected, samples * 9 / 10);
}

TEST(Constraints, NeighboursMayJoinThePiecesOfABlock) {
  Polycube block(3, 5, 5);
  const auto draw = [&block](const meshes::CellIndex& from, const meshes::CellIndex& to) {
    for (int x = from.x; x <= to.x; ++x) {
      for (int y = from.y; y <= to.y; ++y) {
        for (int z = from.z; z <= to.z; ++z) block.set({x, y, z}, 1);
      }
    }
  };
  // A bar along x with an arm at either end, and a second piece that faces the arms of the next copies on either side.
  draw({0, 0, 0}, {2, 0, 0});
  draw({2, 0, 0}, {2, 4, 0});
  draw({0, 0, 0}, {0, 0, 4});
  draw({0, 4, 0}, {0, 4, 2});
  draw({0, 4, 2}, {2, 4, 2});
  draw({2, 0, 2}, {2, 4, 2});
  draw({2, 0, 2}, {2, 0, 4});
  EXPECT_EQ(meshes::count_components(block), 2U);
  const Polycube one = Polycube::from_digits(1, 1, 1, "1");
  const Polycube two = Polycube::from_digits(2, 1, 1, "11");
  EXPECT_FALSE(replacement_is_connected(one, block));
  EXPECT_TRUE(replacement_is_connected(two, block));
  EXPECT_TRUE(meshes::is_connected(meshes::replace_cells(two, block)));
}

TEST(Constraints, AnEmptyMaskOrBlockIsNotConnected) {
  const Polycube none(3, 3, 3);
  EXPECT_FALSE(replacement_is_connected(none, bar_body.body));
  EXPECT_FALSE(replacement_is_connected(bar_body.body, none));
}

TEST(Constraints, AFractalIsDecidedAtLevelTwoForLevelThree) {
  RandomStream random(2, "fractal");
  int apart = 0;
  for (int sample = 0; sample < 400; ++sample) {
    Phenotype phenotype;
    phenotype.body = meshes::largest_component(random_cells(0.3 + 0.4 * random.uniform(), random));
    if (phenotype.body.count() == 0) continue;
    const bool expected = meshes::is_connected(meshes::fractal(phenotype.body, 3));
    ASSERT_EQ(meshes::is_connected(meshes::fractal(phenotype.body, 2)), expected);
    for (const int level : {2, 3}) ASSERT_EQ(aggregate_is_connected(phenotype, level), expected) << phenotype.body.digits();
    apart += expected ? 0 : 1;
  }
  EXPECT_GT(apart, 40);
  EXPECT_LT(apart, 360);
}

TEST(Constraints, ArrangementsAreEvaluatedAsTheBuiltBody) {
  RandomStream random(3, "arrangement");
  for (int sample = 0; sample < 400; ++sample) {
    Phenotype phenotype;
    for (auto* array : {&phenotype.body, &phenotype.arrangement, &phenotype.arrangement_of_arrangements}) {
      *array = meshes::largest_component(random_cells(0.5 + 0.4 * random.uniform(), random));
    }
    for (int level = 1; level <= 3; ++level) {
      ASSERT_EQ(aggregate_is_connected(phenotype, level), meshes::is_connected(aggregate(phenotype, level)))
          << phenotype_key(phenotype);
    }
  }
}

TEST(Constraints, BodiesSmallerThanTheSmallestAreNotValid) {
  const Phenotype pair = phenotype_from_key("110000000000000000000000000");
  ConstraintOptions options;
  EXPECT_FALSE(is_valid(pair, options));
  EXPECT_TRUE(is_valid(bar_body, {3, 27, DisconnectedPolicy::allow, {1, 2, 3}}));
  EXPECT_FALSE(is_valid(bar_body, {4, 27, DisconnectedPolicy::allow, {1, 2, 3}}));
  EXPECT_FALSE(is_valid(phenotype_from_key(std::string(27, '0')), {0, 0, DisconnectedPolicy::allow, {1}}))
      << "an empty body never is";
}

TEST(Constraints, BodiesLargerThanTheLargestAreNotValid) {
  ConstraintOptions options;
  options.levels = {1};
  const std::size_t cells = bar_body.body.count();
  options.largest_body = cells;
  EXPECT_TRUE(is_valid(bar_body, options));
  options.largest_body = cells - 1;
  options.smallest_body = 1;
  EXPECT_EQ(refusal(bar_body, options), Refusal::too_large);
  EXPECT_EQ(to_string(Refusal::too_large), "too large");
  const std::string bar = bar_body.body.digits();
  EXPECT_TRUE(is_valid(phenotype_from_key(bar + "|" + bar + "|" + bar), options))
      << "of a control, the basal body does not matter";
}

TEST(Constraints, DisconnectedPoliciesDiffer) {
  ConstraintOptions options;
  options.disconnected = DisconnectedPolicy::reject;
  EXPECT_FALSE(is_valid(s_body, options));
  EXPECT_FALSE(is_penalised(s_body, options));
  options.disconnected = DisconnectedPolicy::penalise;
  EXPECT_TRUE(is_valid(s_body, options));
  EXPECT_TRUE(is_penalised(s_body, options));
  EXPECT_FALSE(is_penalised(bar_body, options));
  options.disconnected = DisconnectedPolicy::allow;
  EXPECT_TRUE(is_valid(s_body, options));
  EXPECT_FALSE(is_penalised(s_body, options));
}

TEST(Constraints, OnlyTheLevelsOfTheStudyCount) {
  EXPECT_TRUE(is_valid(s_body, {3, 27, DisconnectedPolicy::reject, {1}}));
  EXPECT_FALSE(is_valid(s_body, {3, 27, DisconnectedPolicy::reject, {1, 2}}));
  EXPECT_FALSE(is_valid(s_body, {3, 27, DisconnectedPolicy::reject, {1, 3}}));
}

TEST(Constraints, AControlIsEvaluatedByItsLevelThreeBody) {
  const std::string bar = bar_body.body.digits();
  const std::string cell = "100000000000000000000000000";
  const std::string s = s_body.body.digits();
  const ConstraintOptions allow{3, 27, DisconnectedPolicy::allow, {1, 2}};
  EXPECT_TRUE(is_valid(phenotype_from_key(bar + "|" + bar + "|" + bar), allow)) << "27 cells";
  EXPECT_FALSE(is_valid(phenotype_from_key(bar + "|" + cell + "|" + bar), allow)) << "9 cells";
  const std::string full(27, '1');
  EXPECT_TRUE(is_valid(phenotype_from_key(full + "|" + cell + "|" + cell), allow));
  EXPECT_FALSE(is_valid(phenotype_from_key(s + "|" + bar + "|" + bar), allow)) << "36 cells that fall apart at level 3";
  // The size of the basal body does not matter.
  EXPECT_TRUE(
      is_valid(phenotype_from_key("111111111111111111111111111|" + cell + "|" + cell), {28, 27, DisconnectedPolicy::allow, {1}}));
}

TEST(Constraints, PoliciesHaveOneWordEach) {
  EXPECT_EQ(to_string(DisconnectedPolicy::reject), "reject");
  EXPECT_EQ(to_string(DisconnectedPolicy::penalise), "penalise");
  EXPECT_EQ(to_string(DisconnectedPolicy::allow), "allow");
}

}  // namespace
}  // namespace menger::evolution
