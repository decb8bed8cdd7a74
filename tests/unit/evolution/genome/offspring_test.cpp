#include "evolution/genome/offspring.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "io/text/input_error.h"
#include "tests/support/input_error_message.h"

namespace menger::evolution {
namespace {

OffspringOptions released_options(BodyPlan plan) {
  OffspringOptions options;
  options.variation = {ActivationSet::released_code, OutputFunction::mutable_};
  options.decoder = {plan, {Expression::first_consumer_activated, AxisMap::zyx}};
  options.constraints.disconnected = DisconnectedPolicy::allow;
  return options;
}

TEST(Offspring, RandomOnesAreValidAndDecodeToTheirPhenotype) {
  for (const BodyPlan plan :
       {BodyPlan::fractal, BodyPlan::nonfractal, BodyPlan::nonfractal_two_scales, BodyPlan::single_actuator}) {
    RandomStream random(1, "births");
    for (const auto policy : {DisconnectedPolicy::reject, DisconnectedPolicy::allow}) {
      OffspringOptions options = released_options(plan);
      options.constraints.disconnected = policy;
      for (int sample = 0; sample < 30; ++sample) {
        const Offspring born = random_offspring(options, random);
        EXPECT_TRUE(is_valid(born.phenotype, options.constraints));
        EXPECT_EQ(decode(born.genome, options.decoder), born.phenotype);
        EXPECT_GE(born.tries, 1U);
      }
    }
  }
}

TEST(Offspring, RejectionLeavesNoBodyThatFallsApart) {
  RandomStream random(2, "births");
  OffspringOptions options = released_options(BodyPlan::fractal);
  options.constraints.disconnected = DisconnectedPolicy::reject;
  Offspring individual = random_offspring(options, random);
  for (int generation = 0; generation < 200; ++generation) {
    EXPECT_TRUE(aggregate_is_connected(individual.phenotype, 3));
    individual = child_of(individual.genome, individual.phenotype, options, random);
  }
}

TEST(Offspring, ConstraintsThatCannotBeMetAreAnErrorNotAnEndlessLoop) {
  RandomStream random(3, "births");
  OffspringOptions options = released_options(BodyPlan::fractal);
  options.constraints.smallest_body = 28;
  options.largest_draws = 50;
  EXPECT_THROW(random_offspring(options, random), io::InputError);
}

TEST(Offspring, ChildrenAreValidAndDifferFromTheirParentUnlessEveryTryFailed) {
  for (const BodyPlan plan :
       {BodyPlan::fractal, BodyPlan::nonfractal, BodyPlan::nonfractal_two_scales, BodyPlan::single_actuator}) {
    RandomStream random(4, "children");
    const OffspringOptions options = released_options(plan);
    int equal = 0;
    for (int sample = 0; sample < 50; ++sample) {
      const Offspring parent = random_offspring(options, random);
      const Offspring child = child_of(parent.genome, parent.phenotype, options, random);
      if (child.phenotype == parent.phenotype) {
        // Some full cubes cannot be changed by a single step.
        ++equal;
        EXPECT_GE(child.tries, options.largest_tries);
      }
      EXPECT_TRUE(is_valid(child.phenotype, options.constraints));
      EXPECT_EQ(decode(child.genome, options.decoder), child.phenotype);
    }
    EXPECT_LT(equal, 10);
  }
}

TEST(Offspring, AParentIsCopiedWhenEveryTryFails) {
  RandomStream random(5, "failures");
  OffspringOptions options = released_options(BodyPlan::fractal);
  const Offspring parent = random_offspring(options, random);
  options.constraints.smallest_body = 28;
  const Offspring child = child_of(parent.genome, parent.phenotype, options, random);
  EXPECT_EQ(child.tries, 1500U);
  EXPECT_EQ(child.genome, parent.genome);
  EXPECT_EQ(child.phenotype, parent.phenotype);
}

TEST(Offspring, AChildIsNoneThatIsRefusedWhileThereAreOthers) {
  for (const BodyPlan plan : {BodyPlan::fractal, BodyPlan::nonfractal_two_scales}) {
    RandomStream random(12, "refused");
    const OffspringOptions options = released_options(plan);
    Offspring parent = random_offspring(options, random);
    while (parent.phenotype.body.count() > 18) parent = random_offspring(options, random);  // a full cube has few others near it
    std::set<std::string> had;
    const auto is_refused = [&](const Phenotype& phenotype) { return had.contains(phenotype_key(phenotype)); };
    for (int sample = 0; sample < 50; ++sample) {
      const Offspring child = child_of(parent.genome, parent.phenotype, options, random, is_refused);
      EXPECT_EQ(decode(child.genome, options.decoder), child.phenotype);
      if (child.phenotype == parent.phenotype) {
        EXPECT_GE(child.tries, options.largest_tries) << "one step leads to no other body";
      } else {
        EXPECT_TRUE(had.insert(phenotype_key(child.phenotype)).second);
      }
    }
    EXPECT_GT(had.size(), 10U);
    const Offspring none = child_of(parent.genome, parent.phenotype, options, random, [](const Phenotype&) { return true; });
    EXPECT_EQ(none.genome, parent.genome);
    EXPECT_EQ(none.phenotype, parent.phenotype);
  }
}

TEST(Offspring, EachOfThreeNetworksIsChosenWithOneThirdAndAtLeastOneIs) {
  RandomStream random(6, "choice");
  const OffspringOptions options = released_options(BodyPlan::nonfractal);
  const Offspring parent = random_offspring(options, random);
  std::array<int, 4> counts{};
  constexpr int samples = 3000;
  for (int sample = 0; sample < samples; ++sample) {
    const Offspring child = child_of(parent.genome, parent.phenotype, options, random);
    std::size_t changed = 0;
    for (std::size_t network = 0; network < 3; ++network)
      changed += child.genome.networks[network] != parent.genome.networks[network] ? 1U : 0U;
    ++counts.at(changed);
  }
  // If none is chosen (8/27), one is drawn. Hence the probabilities: one 12/27 + 8/27, two 6/27, three 1/27.
  constexpr std::array expected{0.0, 20.0 / 27.0, 6.0 / 27.0, 1.0 / 27.0};
  for (std::size_t changed = 0; changed < counts.size(); ++changed) {
    const double probability = expected.at(changed);
    EXPECT_NEAR(counts.at(changed) / static_cast<double>(samples), probability,
                4.0 * std::sqrt(probability * (1.0 - probability) / samples))
        << changed;
  }
}

TEST(Offspring, ChildrenThatMayNotKeepTheBodyHaveAnotherOneAndVaryTheirArrangementsAsOften) {
  for (const BodyPlan plan : {BodyPlan::nonfractal_two_scales, BodyPlan::nonfractal}) {
    RandomStream random(9, "body");
    OffspringOptions options = released_options(plan);
    const Offspring parent = random_offspring(options, random);
    constexpr int samples = 1000;
    std::array<int, 2> arranged{};
    for (const bool may_keep : {true, false}) {
      options.mutants_may_keep_body = may_keep;
      for (int sample = 0; sample < samples; ++sample) {
        const Phenotype child = child_of(parent.genome, parent.phenotype, options, random).phenotype;
        ASSERT_TRUE(may_keep || child.body != parent.phenotype.body);
        const bool is_arranged = child.arrangement != parent.phenotype.arrangement ||
                                 child.arrangement_of_arrangements != parent.phenotype.arrangement_of_arrangements;
        arranged.at(may_keep ? 0 : 1) += is_arranged ? 1 : 0;
      }
    }
    // Four standard deviations of the difference of two shares.
    const double share = arranged[0] / static_cast<double>(samples);
    EXPECT_GT(share, 0.2);
    EXPECT_NEAR(arranged[1] / static_cast<double>(samples), share, 4.0 * std::sqrt(2.0 * share * (1.0 - share) / samples))
        << to_string(plan);
  }
}

TEST(Offspring, AChildEqualsItsParentWhereTheBodyMustChangeAndNoTryDid) {
  RandomStream random(10, "body");
  OffspringOptions options = released_options(BodyPlan::nonfractal_two_scales);
  const Offspring parent = random_offspring(options, random);
  options.mutants_may_keep_body = false;
  options.largest_tries = 1;
  int kept = 0;
  for (int sample = 0; sample < 200; ++sample) {
    const Offspring child = child_of(parent.genome, parent.phenotype, options, random);
    if (child.phenotype.body != parent.phenotype.body) continue;
    ++kept;
    EXPECT_EQ(child.genome, parent.genome);
    EXPECT_EQ(child.phenotype, parent.phenotype);
  }
  EXPECT_GT(kept, 20);
}

TEST(Offspring, ChildrenDifferInAsManyCellsAsTheyMay) {
  for (const BodyPlan plan : {BodyPlan::fractal, BodyPlan::nonfractal}) {
    RandomStream random(11, "cells");
    OffspringOptions options = released_options(plan);
    Offspring parent = random_offspring(options, random);
    while (parent.phenotype.body.count() > 18)
      parent = random_offspring(options, random);  // hardly a step changes one cell of a full cube
    const std::string parent_key = phenotype_key(parent.phenotype);
    for (const std::size_t most : {1U, 3U}) {
      options.most_changed_cells = most;
      std::set<std::size_t> counts;
      for (int sample = 0; sample < 100; ++sample) {
        const std::string key = phenotype_key(child_of(parent.genome, parent.phenotype, options, random).phenotype);
        std::size_t changed = 0;
        for (std::size_t cell = 0; cell < key.size(); ++cell) changed += key[cell] != parent_key[cell] ? 1U : 0U;
        counts.insert(changed);
      }
      EXPECT_EQ(*counts.rbegin(), most) << to_string(plan);
    }
  }
}

TEST(Offspring, ConstraintsThatNoBodyMeetsAreNamed) {
  for (const auto& [plan, word] : {std::pair{BodyPlan::fractal, "smallest_body_cells = 28"},
                                   {BodyPlan::single_actuator, "smallest_body_cells = 28"},
                                   {BodyPlan::nonfractal, "smallest_arranged_body_cells = 20000"}}) {
    OffspringOptions options = released_options(plan);
    options.constraints.smallest_body = 28;
    options.constraints.smallest_arranged_body = 20000;
    options.largest_draws = 3;
    RandomStream random(8, "none");
    const std::string message = tests::message_of([&] { (void)random_offspring(options, random); });
    EXPECT_NE(message.find(word), std::string::npos) << message;
  }
}

TEST(Offspring, SameStreamSameOffspring) {
  const OffspringOptions options = released_options(BodyPlan::nonfractal);
  RandomStream first(7, "same");
  RandomStream second(7, "same");
  const Offspring a = random_offspring(options, first);
  const Offspring b = random_offspring(options, second);
  EXPECT_EQ(to_text(a.genome), to_text(b.genome));
  EXPECT_EQ(to_text(child_of(a.genome, a.phenotype, options, first).genome),
            to_text(child_of(b.genome, b.phenotype, options, second).genome));
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace menger::evolution
