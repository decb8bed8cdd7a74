#include "evolution/genome/genome.h"

#include <gtest/gtest.h>

#include <string>

#include "io/text/input_error.h"

namespace menger::evolution {
namespace {

constexpr BodyPlan plans[] = {BodyPlan::fractal, BodyPlan::nonfractal, BodyPlan::nonfractal_two_scales,
                              BodyPlan::single_actuator};

TEST(Genome, HasTheNetworksOfItsPlan) {
  RandomStream random(1, "genome");
  for (const BodyPlan plan : plans) {
    const Genome genome = random_genome(plan, {}, random);
    EXPECT_TRUE(fits(genome, plan));
    for (const BodyPlan other : plans) EXPECT_EQ(fits(genome, other), other == plan);
  }
  EXPECT_EQ(networks_of(BodyPlan::fractal).size(), 1U);
  EXPECT_EQ(networks_of(BodyPlan::nonfractal).size(), 3U);
  EXPECT_EQ(networks_of(BodyPlan::nonfractal_two_scales).size(), 2U);
}

TEST(Genome, SingleOutputsHandOnTheirPlainSum) {
  RandomStream random(2, "genome");
  const VariationOptions released{ActivationSet::released_code, OutputFunction::mutable_};
  const Genome genome = random_genome(BodyPlan::nonfractal, released, random);
  EXPECT_EQ(genome.networks[1].nodes[cppn_input_count].activation, Activation::identity);
  EXPECT_EQ(genome.networks[2].nodes[cppn_input_count].activation, Activation::identity);
  const Genome single = random_genome(BodyPlan::single_actuator, released, random);
  EXPECT_EQ(single.networks[0].nodes[cppn_input_count].activation, Activation::identity);
}

TEST(Genome, ReadsBackEveryBitOfItsText) {
  RandomStream random(3, "genome");
  for (const BodyPlan plan : plans) {
    for (int sample = 0; sample < 50; ++sample) {
      const Genome genome = random_genome(plan, {}, random);
      EXPECT_EQ(genome_from_text(to_text(genome)), genome);
    }
  }
}

TEST(Genome, RefusesTextsThatAreNoGenome) {
  for (const std::string text : {"", "network", "network\n", "outputs sine\n", "network\noutputs sine\nnetwork\n",
                                 "network\nnetwork\noutputs sine\n", "network\noutputs sine\nnetwork 2\noutputs sine\n"}) {
    EXPECT_THROW(genome_from_text(text), io::InputError) << text;
  }
}

TEST(Genome, PlansHaveOneWordEach) {
  EXPECT_EQ(to_string(BodyPlan::fractal), "fractal");
  EXPECT_EQ(to_string(BodyPlan::nonfractal), "nonfractal");
  EXPECT_EQ(to_string(BodyPlan::nonfractal_two_scales), "nonfractal-two-scales");
  EXPECT_EQ(to_string(BodyPlan::single_actuator), "single-actuator");
}

}  // namespace
}  // namespace menger::evolution
