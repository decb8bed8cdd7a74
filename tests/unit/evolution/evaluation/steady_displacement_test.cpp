#include "evolution/evaluation/steady_displacement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace menger::evolution {
namespace {

using Vector = std::array<double, 3>;

const Vector step{1e-3, -2e-3, 1e-5};
const LastPeriods last_five{.period_s = 0.5, .count = 5};

TEST(SteadyDisplacement, OfASteadyWalkerIsThatOfAPeriod) {
  EXPECT_EQ(steady_displacement_m(PeriodDisplacements(5, step)), step);
  EXPECT_EQ(steady_displacement_m(PeriodDisplacements(1, step)), step);
  const PeriodDisplacements uneven{{1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {5.0, 0.0, 0.0}};
  EXPECT_DOUBLE_EQ(steady_displacement_m(uneven)[0], 2.5) << "of the means 1.5, 2.5, 3.5, 4.5 the smaller one in the middle";
}

TEST(SteadyDisplacement, LeavesOutStartUp) {
  PeriodDisplacements periods(6, step);
  periods.front() = {0.5, 0.5, -0.1};
  EXPECT_EQ(steady_displacement_m(periods, last_five), step);
}

TEST(SteadyDisplacement, OneFallDoesNotCountWhereverItIs) {
  for (std::size_t place = 0; place < 5; ++place) {
    PeriodDisplacements periods(5, step);
    periods[place] = {0.02, 0.03, -0.01};
    EXPECT_EQ(steady_displacement_m(periods), step) << place;
    PeriodDisplacements resting(5, Vector{});
    resting[place] = {0.02, 0.03, -0.01};
    EXPECT_EQ(steady_displacement_m(resting), Vector{}) << "a body that falls over and lies there, " << place;
  }
}

TEST(SteadyDisplacement, OfABodyThatRocksIsNothing) {
  for (std::size_t count = 2; count <= 9; ++count) {
    PeriodDisplacements rocking;
    for (std::size_t n = 0; n < count; ++n) rocking.push_back(n % 2 == 0 ? Vector{0.01, -0.004, 0.0} : Vector{-0.01, 0.004, 0.0});
    EXPECT_EQ(steady_displacement_m(rocking), Vector{}) << count << " periods; the median of them is not 0 for odd numbers";
  }
  // It rocks and creeps.
  PeriodDisplacements creeping;
  for (int n = 0; n < 6; ++n) creeping.push_back({(n % 2 == 0 ? 0.01 : -0.01) + 2e-4, 0.0, 0.0});
  EXPECT_NEAR(steady_displacement_m(creeping)[0], 2e-4, 1e-15);
}

TEST(SteadyDisplacement, AWalkerBeatsABodyThatFallsAndRocks) {
  for (std::size_t place = 0; place < 6; ++place) {
    PeriodDisplacements fallen;
    for (int n = 0; n < 6; ++n) fallen.push_back({n % 2 == 0 ? 0.004 : -0.003, 0.0, 0.0});
    fallen[place] = {0.03, 0.01, -0.01};
    const PeriodDisplacements walker(6, Vector{0.0015, 0.0, 0.0});
    const auto distance = [](const Vector& v) { return std::hypot(v[0], v[1]); };
    const auto net = [](const PeriodDisplacements& periods) {
      double sum = 0.0;
      for (const Vector& one : periods) sum += one[0];
      return sum;
    };
    EXPECT_GT(net(fallen), net(walker)) << "by its net displacement it would win";
    EXPECT_LT(distance(steady_displacement_m(fallen, last_five).value()),
              distance(steady_displacement_m(walker, last_five).value()))
        << place;
  }
}

TEST(SteadyDisplacement, NeedsEnoughPeriods) {
  EXPECT_FALSE(steady_displacement_m(PeriodDisplacements(4, step), last_five));
  EXPECT_TRUE(steady_displacement_m(PeriodDisplacements(5, step), last_five));
  EXPECT_EQ(whole_periods(2.0, 1.0 / 3.0), 6U);
  EXPECT_EQ(whole_periods(1.9, 1.0 / 3.0), 5U);
  EXPECT_EQ(whole_periods(0.1, 1.0 / 3.0), 0U);
}

}  // namespace
}  // namespace menger::evolution
