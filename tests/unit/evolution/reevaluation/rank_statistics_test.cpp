#include "evolution/reevaluation/rank_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "evolution/genome/random_stream.h"

namespace menger::evolution {
namespace {

using Values = std::vector<double>;

TEST(RankStatistics, EqualValuesShareTheMeanOfTheirRanks) {
  EXPECT_EQ(mid_ranks(Values{10.0, 30.0, 20.0}), (Values{1.0, 3.0, 2.0}));
  EXPECT_EQ(mid_ranks(Values{2.0, 1.0, 2.0, 3.0}), (Values{2.5, 1.0, 2.5, 4.0}));
  EXPECT_EQ(mid_ranks(Values{7.0, 7.0, 7.0}), (Values{2.0, 2.0, 2.0}));
  EXPECT_TRUE(mid_ranks(Values{}).empty());
}

TEST(RankStatistics, SpearmanAgreesWithPublishedAndHandComputedValues) {
  // squared differences of the ranks 1 + 1 + 1 + 1: 1 - 6 * 4 / (5 * 24)
  EXPECT_NEAR(spearman_correlation(Values{1, 2, 3, 4, 5}, Values{2, 1, 4, 3, 5}).value().value, 0.8, 1e-15);
  // the example of scipy.stats.spearmanr, with a tie: 0.8207826816681233
  EXPECT_NEAR(spearman_correlation(Values{1, 2, 3, 4, 5}, Values{5, 6, 7, 8, 7}).value().value, 0.8207826816681233, 1e-15);
}

TEST(RankStatistics, KendallAgreesWithPublishedAndHandComputedValues) {
  // 8 concordant and 2 discordant pairs of 10
  EXPECT_NEAR(kendall_correlation(Values{1, 2, 3, 4, 5}, Values{2, 1, 4, 3, 5}).value().value, 0.6, 1e-15);
  // the example of scipy.stats.kendalltau, with ties on both sides: -0.47140452079103173
  EXPECT_NEAR(kendall_correlation(Values{12, 2, 1, 12, 2}, Values{1, 4, 7, 1, 0}).value().value, -0.47140452079103173, 1e-15);
}

TEST(RankStatistics, IntervalsAreThoseOfBonettAndWright) {
  const Values x{1, 2, 3, 4, 5};
  const Values y{2, 1, 4, 3, 5};
  // tanh(artanh 0.8 -+ 1.959964 sqrt(1.32 / 2)) and tanh(artanh 0.6 -+ 1.959964 sqrt(0.437)), computed independently
  const Interval rho = spearman_correlation(x, y).value().interval.value();
  EXPECT_NEAR(rho.low, -0.4571244, 1e-6);
  EXPECT_NEAR(rho.high, 0.9908429, 1e-6);
  const Interval tau = kendall_correlation(x, y).value().interval.value();
  EXPECT_NEAR(tau.low, -0.5388305, 1e-6);
  EXPECT_NEAR(tau.high, 0.9632277, 1e-6);
}

TEST(RankStatistics, WhatHasNoAnswerHasNone) {
  EXPECT_FALSE(spearman_correlation(Values{}, Values{}));
  EXPECT_FALSE(kendall_correlation(Values{1.0}, Values{1.0}));
  EXPECT_FALSE(spearman_correlation(Values{1, 1, 1}, Values{1, 2, 3})) << "all alike";
  EXPECT_FALSE(kendall_correlation(Values{1, 2, 3}, Values{5, 5, 5})) << "all alike";
  EXPECT_FALSE(spearman_correlation(Values{1, 2, 3}, Values{1, 3, 2}).value().interval) << "three pairs";
  EXPECT_FALSE(kendall_correlation(Values{1, 2, 3, 4}, Values{1, 3, 2, 4}).value().interval) << "four pairs";
  const auto perfect = spearman_correlation(Values{1, 2, 3, 4, 5, 6}, Values{2, 3, 5, 7, 11, 13}).value();
  EXPECT_EQ(perfect.value, 1.0);
  EXPECT_FALSE(perfect.interval) << "Fisher's z is infinite";
  EXPECT_EQ(kendall_correlation(Values{1, 2, 3}, Values{3, 2, 1}).value().value, -1.0);
}

TEST(RankStatistics, IntervalsHoldTheTrueCorrelationAboutAsOftenAsTheySay) {
  // Pairs of normal deviates with correlation r have rho = 6 / pi arcsin(r / 2) and tau = 2 / pi arcsin(r). Over 4000 trials the
  // share is within 0.01 (three standard errors) of the true coverage. The interval is an approximation: for 20 pairs and this r
  // its coverage is within about 0.01 of 0.95.
  constexpr double r = 0.6;
  const double rho = 6.0 / std::numbers::pi * std::asin(0.5 * r);
  const double tau = 2.0 / std::numbers::pi * std::asin(r);
  constexpr int trials = 4000;
  RandomStream random(1, "coverage");
  int held_rho = 0;
  int held_tau = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Values x;
    Values y;
    for (int n = 0; n < 20; ++n) {
      x.push_back(random.normal(0.0, 1.0));
      y.push_back(r * x.back() + std::sqrt(1.0 - r * r) * random.normal(0.0, 1.0));
    }
    const auto holds = [](const Interval& interval, double value) { return interval.low <= value && value <= interval.high; };
    if (holds(spearman_correlation(x, y).value().interval.value(), rho)) ++held_rho;
    if (holds(kendall_correlation(x, y).value().interval.value(), tau)) ++held_tau;
  }
  EXPECT_NEAR(static_cast<double>(held_rho) / trials, 0.95, 0.02);
  EXPECT_NEAR(static_cast<double>(held_tau) / trials, 0.95, 0.02);
}

TEST(RankStatistics, SharesHaveWilsonsInterval) {
  // 81 of 263: 0.2553 to 0.3662, as published (Newcombe 1998)
  const Share found = share(81, 263).value();
  EXPECT_NEAR(found.value, 0.30798, 1e-5);
  EXPECT_NEAR(found.interval.low, 0.2553, 5e-5);
  EXPECT_NEAR(found.interval.high, 0.3662, 5e-5);
  EXPECT_EQ(share(0, 5).value().interval.low, 0.0);
  EXPECT_EQ(share(5, 5).value().interval.high, 1.0);
  EXPECT_FALSE(share(0, 0));
}

TEST(RankStatistics, RegretIsWhatTheSurrogatesBestLeaveOut) {
  const Values surrogate{5, 4, 3, 2, 1};
  const Values reference{2, 3, 7, 1, 6};
  const TopRegret first = top_regret(surrogate, reference, 1).value();
  EXPECT_EQ(first.best, 7.0);
  EXPECT_EQ(first.regret, 5.0);
  EXPECT_EQ(first.shared, 0U);
  const TopRegret two = top_regret(surrogate, reference, 2).value();
  EXPECT_EQ(two.best_of_top, 3.0);
  EXPECT_EQ(two.regret, 4.0);
  EXPECT_EQ(two.shared, 0U) << "places 0 and 1 against 2 and 4";
  EXPECT_EQ(top_regret(surrogate, reference, 3).value().regret, 0.0);
  EXPECT_EQ(top_regret(surrogate, reference, 3).value().shared, 2U) << "1 and 2 of 2, 4, 1";
  EXPECT_EQ(top_regret(Values{1, 1}, Values{3, 4}, 1).value().regret, 1.0) << "of equals the first is taken";
  EXPECT_FALSE(top_regret(surrogate, reference, 6));
}

}  // namespace
}  // namespace menger::evolution
