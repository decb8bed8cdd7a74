#include "evolution/genome/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "io/text/input_error.h"

namespace menger::evolution {
namespace {

/// Returns four standard deviations of the frequency of an event with this probability, over this number of draws.
double share_tolerance(double probability, int draws) { return 4.0 * std::sqrt(probability * (1.0 - probability) / draws); }

TEST(RandomStream, GivesThePublishedSequenceOfItsGenerator) {
  RandomStream random = RandomStream::from_text("xoshiro256** 1 2 3 4");
  EXPECT_EQ(random.bits(), 11520U);
  EXPECT_EQ(random.bits(), 0U);
  EXPECT_EQ(random.bits(), 1509978240U);
  EXPECT_EQ(random.bits(), 1215971899390074240U);
}

TEST(RandomStream, DependsOnSeedAndPurposeOnly) {
  RandomStream first(7, "variation");
  RandomStream again(7, "variation");
  RandomStream other_seed(8, "variation");
  RandomStream other_purpose(7, "selection");
  for (int draw = 0; draw < 100; ++draw) {
    const auto bits = first.bits();
    EXPECT_EQ(bits, again.bits());
    EXPECT_NE(bits, other_seed.bits());
    EXPECT_NE(bits, other_purpose.bits());
  }
}

TEST(RandomStream, ContinuesFromItsText) {
  RandomStream random(1, "text");
  for (int draw = 0; draw < 17; ++draw) random.normal(0.0, 1.0);
  RandomStream copy = RandomStream::from_text(random.to_text());
  EXPECT_EQ(copy, random);
  for (int draw = 0; draw < 17; ++draw) EXPECT_EQ(copy.normal(0.0, 1.0), random.normal(0.0, 1.0));
}

TEST(RandomStream, RefusesTextsThatAreNoState) {
  for (const char* text : {"", "xoshiro256**", "xoshiro256** 1 2 3", "xoshiro256** 1 2 3 4 5", "xoshiro256** 0 0 0 0",
                           "xoshiro256** 1 2 3 g", "xoshiro256** 1 2 3 12345678901234567", "mt19937 1 2 3 4"}) {
    EXPECT_THROW(RandomStream::from_text(text), io::InputError) << text;
  }
}

TEST(RandomStream, DrawsIntegersUniformly) {
  RandomStream random(2, "below");
  constexpr int draws = 60000;
  std::array<int, 6> counts{};
  for (int draw = 0; draw < draws; ++draw) ++counts.at(random.below(counts.size()));
  for (const int count : counts) EXPECT_NEAR(count / static_cast<double>(draws), 1.0 / 6.0, share_tolerance(1.0 / 6.0, draws));
  EXPECT_EQ(random.below(1), 0U);
}

TEST(RandomStream, DrawsDoublesOfTheHalfOpenUnitInterval) {
  RandomStream random(3, "uniform");
  constexpr int draws = 100000;
  double sum = 0.0;
  for (int draw = 0; draw < draws; ++draw) {
    const double value = random.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
  }
  EXPECT_NEAR(sum / draws, 0.5, 4.0 / std::sqrt(12.0 * draws));
}

TEST(RandomStream, DrawsNormalDeviates) {
  RandomStream random(4, "normal");
  constexpr int draws = 100000;
  double sum = 0.0;
  double squares = 0.0;
  int within_one = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const double deviate = (random.normal(3.0, 0.5) - 3.0) / 0.5;
    sum += deviate;
    squares += deviate * deviate;
    within_one += std::abs(deviate) < 1.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / draws, 0.0, 4.0 / std::sqrt(draws));
  EXPECT_NEAR(squares / draws, 1.0, 4.0 * std::sqrt(2.0 / draws));
  EXPECT_NEAR(within_one / static_cast<double>(draws), 0.682689, share_tolerance(0.682689, draws));
}

TEST(RandomStream, ShufflesIntoEveryOrderAlike) {
  RandomStream random(5, "shuffle");
  constexpr int draws = 60000;
  std::map<std::vector<int>, int> counts;
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<int> items{1, 2, 3};
    random.shuffle(items);
    ++counts[items];
  }
  EXPECT_EQ(counts.size(), 6U);
  for (const auto& [order, count] : counts)
    EXPECT_NEAR(count / static_cast<double>(draws), 1.0 / 6.0, share_tolerance(1.0 / 6.0, draws));
}

}  // namespace
}  // namespace menger::evolution
