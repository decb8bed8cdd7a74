#include "evolution/genome/decoder.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "io/text/input_error.h"
#include "meshes/design/connectivity.h"
#include "meshes/design/fractal.h"

namespace menger::evolution {
namespace {

Genome genome_of(const std::string& edges) { return {{cppn_from_text("outputs identity identity\n" + edges)}}; }

std::string digits_of(const std::string& edges) { return decode(genome_of(edges), {}).body.digits(); }

TEST(Decoder, PositiveFirstOutputIsACellAndPositiveSecondOneMaterialTwo) {
  EXPECT_EQ(digits_of("edge z out0 -1\nedge x out1 1\n"), "112112112000000000000000000");
  EXPECT_EQ(digits_of("edge b out0 0\n"), std::string(27, '0')) << "zero is no cell";
}

TEST(Decoder, KeepsTheLargestComponentOfThePresenceWhateverTheMaterials) {
  // |x| > 1/2 leaves the planes x = −1 and x = 1, which are equally large. The first in grid order stays; its top is material 2.
  EXPECT_EQ(digits_of("hidden 0 absolute\nedge x h0 1\nedge h0 out0 1\nedge b out0 -0.5\nedge z out1 1\n"),
            "100100100100100100200200200");
}

TEST(Decoder, NotANumberIsNoCellAndMaterialOne) {
  // h1 − h2 is ∞ − ∞ off the plane x = 0, where it is 0.
  const std::string nan =
      "hidden 0 square\nhidden 1 square\nhidden 2 square\nedge x h0 1e200\nedge h0 h1 1e200\nedge h0 h2 1e200\n";
  EXPECT_EQ(digits_of(nan + "edge h1 out0 1\nedge h2 out0 -1\nedge b out0 1\n"), "010010010010010010010010010");
  EXPECT_EQ(digits_of(nan + "edge b out0 1\nedge h1 out1 1\nedge h2 out1 -1\nedge b out1 1\n"), "121121121121121121121121121");
}

TEST(Decoder, SingleActuatorHasOneMaterial) {
  RandomStream random(1, "single");
  const DecoderOptions options{BodyPlan::single_actuator, {}};
  for (int sample = 0; sample < 200; ++sample) {
    const Phenotype phenotype = decode(random_genome(BodyPlan::single_actuator, {}, random), options);
    EXPECT_EQ(phenotype.body.digits().find('2'), std::string::npos);
    EXPECT_FALSE(phenotype.has_arrangements());
  }
}

TEST(Decoder, AxisMapTurnsTheBody) {
  const Genome genome = genome_of("edge x out0 -1\n");
  EXPECT_EQ(decode(genome, {BodyPlan::fractal, {Expression::every_consumer_activated, AxisMap::xyz}}).body.digits(),
            "100100100100100100100100100");
  EXPECT_EQ(decode(genome, {BodyPlan::fractal, {Expression::every_consumer_activated, AxisMap::zyx}}).body.digits(),
            "111111111000000000000000000");
}

TEST(Decoder, FractalAggregatesItself) {
  const Phenotype phenotype = phenotype_from_key("111112100000000000000000000");
  EXPECT_EQ(aggregate(phenotype, 1), phenotype.body);
  EXPECT_EQ(aggregate(phenotype, 2), meshes::fractal(phenotype.body, 2));
  EXPECT_EQ(aggregate(phenotype, 3), meshes::fractal(phenotype.body, 3));
  EXPECT_EQ(aggregate_cell_count(phenotype, 3), 343U);
}

TEST(Decoder, ArrangementsAreFilledWithTheBody) {
  const std::string body = "121000000000000000000000000";
  const std::string arrangement = "100100000000000000000000000";
  const std::string outer = "100000000100000000100000000";
  const Phenotype phenotype = phenotype_from_key(body + "|" + arrangement + "|" + outer);
  EXPECT_EQ(aggregate(phenotype, 1), phenotype.body);
  const meshes::Polycube second = aggregate(phenotype, 2);
  EXPECT_EQ(second, meshes::replace_cells(phenotype.arrangement, phenotype.body));
  EXPECT_EQ(second.count(), 6U);
  EXPECT_EQ(second.at({1, 3, 0}), 2) << "the second basal body lies behind the first, with its own materials";
  const meshes::Polycube third = aggregate(phenotype, 3);
  EXPECT_EQ(third.nx(), 27);
  EXPECT_EQ(third.count(), 18U);
  EXPECT_EQ(third.at({1, 3, 18}), 2);
  for (int level = 1; level <= 3; ++level) EXPECT_EQ(aggregate_cell_count(phenotype, level), aggregate(phenotype, level).count());
  EXPECT_THROW(aggregate(phenotype, 4), std::invalid_argument);
  EXPECT_THROW(aggregate(phenotype, 0), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(aggregate_cell_count(phenotype, 4)), std::invalid_argument);
}

TEST(Decoder, ArraysAreConnectedAndArrangementsOfMaterialOne) {
  RandomStream random(2, "arrangements");
  for (int sample = 0; sample < 200; ++sample) {
    const Genome genome = random_genome(BodyPlan::nonfractal, {}, random);
    const Phenotype phenotype = decode(genome, {BodyPlan::nonfractal, {}});
    for (const auto* array : {&phenotype.body, &phenotype.arrangement, &phenotype.arrangement_of_arrangements}) {
      EXPECT_TRUE(array->count() == 0 || meshes::is_connected(*array));
    }
    EXPECT_EQ(phenotype.arrangement.digits().find('2'), std::string::npos);
  }
}

TEST(Decoder, TwoScalesHaveNoThird) {
  RandomStream random(4, "two scales");
  constexpr BodyPlan plan = BodyPlan::nonfractal_two_scales;
  EXPECT_EQ(largest_level(plan), 2);
  EXPECT_EQ(largest_level(BodyPlan::nonfractal), 3);
  EXPECT_GT(largest_level(BodyPlan::fractal), 100);
  for (int sample = 0; sample < 100; ++sample) {
    const Phenotype phenotype = decode(random_genome(plan, {}, random), {plan, {}});
    EXPECT_EQ(aggregate_cell_count(phenotype, 3), aggregate_cell_count(phenotype, 2));
    EXPECT_EQ(aggregate_cell_count(phenotype, 2), phenotype.arrangement.count() * phenotype.body.count());
  }
}

TEST(Decoder, KeysTellPhenotypesApartAndReadBack) {
  RandomStream random(3, "keys");
  for (const BodyPlan plan : {BodyPlan::fractal, BodyPlan::nonfractal, BodyPlan::nonfractal_two_scales}) {
    for (int sample = 0; sample < 100; ++sample) {
      const Phenotype a = decode(random_genome(plan, {}, random), {plan, {}});
      const Phenotype b = decode(random_genome(plan, {}, random), {plan, {}});
      EXPECT_EQ(phenotype_key(a) == phenotype_key(b), a == b);
      EXPECT_EQ(phenotype_from_key(phenotype_key(a)), a);
      EXPECT_EQ(phenotype_hash(a).size(), 64U);
      EXPECT_EQ(phenotype_hash(a) == phenotype_hash(b), a == b);
    }
  }
}

TEST(Decoder, RefusesKeysThatAreNone) {
  const std::string ones(27, '1');
  const std::string two_arrays = ones + "|" + ones;
  const std::string no_separators(83, '1');
  for (const std::string& key : {std::string(), ones.substr(1), ones.substr(1) + "3", two_arrays, no_separators}) {
    EXPECT_THROW(phenotype_from_key(key), io::InputError) << key;
  }
}

}  // namespace
}  // namespace menger::evolution
