#include "fem/statics/limit_point.h"

#include <gtest/gtest.h>

namespace menger::fem {
namespace {

/// A point on p = 6000 - 1e15 (V - 3e-6)^2, in Pa and m^3, as that of the second of two plena.
PathPoint on_parabola(double volume_m3) {
  PathPoint point;
  point.pressures_Pa = {0.0, 6000.0 - 1e15 * (volume_m3 - 3e-6) * (volume_m3 - 3e-6)};
  point.plenum_volumes_m3 = {1e-6, volume_m3};
  return point;
}

TEST(LimitPoint, BetweenThreeStatesIsTheTopOfTheirParabola) {
  const auto top = pressure_extremum(on_parabola(2.2e-6), on_parabola(2.8e-6), on_parabola(3.9e-6), 1);
  ASSERT_TRUE(top);
  EXPECT_EQ(top->plenum, 1U);
  EXPECT_TRUE(top->passed);
  EXPECT_NEAR(top->pressure_Pa, 6000.0, 1e-9);
  EXPECT_NEAR(top->volume_m3, 3e-6, 1e-18);
}

TEST(LimitPoint, IsFoundOnTheWayBackToo) {
  const auto top = pressure_extremum(on_parabola(3.9e-6), on_parabola(2.8e-6), on_parabola(2.2e-6), 1);
  ASSERT_TRUE(top);
  EXPECT_NEAR(top->volume_m3, 3e-6, 1e-18);
}

TEST(LimitPoint, MayBeAMinimum) {
  std::array<PathPoint, 3> points{on_parabola(2.2e-6), on_parabola(2.8e-6), on_parabola(3.9e-6)};
  for (PathPoint& point : points) point.pressures_Pa[1] *= -1.0;
  const auto bottom = pressure_extremum(points[0], points[1], points[2], 1);
  ASSERT_TRUE(bottom);
  EXPECT_NEAR(bottom->pressure_Pa, -6000.0, 1e-9);
}

TEST(LimitPoint, IsNotWhereThePressureOnlyRises) {
  EXPECT_FALSE(pressure_extremum(on_parabola(1.0e-6), on_parabola(2.0e-6), on_parabola(2.9e-6), 1));
  EXPECT_FALSE(pressure_extremum(on_parabola(1.0e-6), on_parabola(2.0e-6), on_parabola(2.9e-6), 0));
}

// Pressure and volume turn together: the drive has a corner, the body no limit.
TEST(LimitPoint, IsNotWhereTheDriveTurns) {
  EXPECT_FALSE(pressure_extremum(on_parabola(1.0e-6), on_parabola(2.0e-6), on_parabola(1.2e-6), 1));
}

TEST(LimitPoint, AheadOfThreeStatesIsTheTopOfTheirParabola) {
  const auto top = extrapolated_limit(on_parabola(2.0e-6), on_parabola(2.5e-6), on_parabola(2.8e-6), 1);
  ASSERT_TRUE(top);
  EXPECT_FALSE(top->passed);
  EXPECT_NEAR(top->pressure_Pa, 6000.0, 1e-9);
  EXPECT_NEAR(top->volume_m3, 3e-6, 1e-18);
}

TEST(LimitPoint, FarAheadIsNotBelieved) {
  EXPECT_FALSE(extrapolated_limit(on_parabola(1.0e-6), on_parabola(1.05e-6), on_parabola(1.1e-6), 1));
}

TEST(LimitPoint, IsNotAheadOfAStraightOrStiffeningCurve) {
  std::array<PathPoint, 3> points{on_parabola(1.0e-6), on_parabola(2.0e-6), on_parabola(3.0e-6)};
  for (const double power : {1.0, 2.0}) {
    for (PathPoint& point : points) point.pressures_Pa[1] = 1e3 * std::pow(point.plenum_volumes_m3[1] * 1e6, power);
    EXPECT_FALSE(extrapolated_limit(points[0], points[1], points[2], 1));
  }
}

// The parabola turned between the last two states already: its top lies behind.
TEST(LimitPoint, BehindTheLastStateIsNotAhead) {
  EXPECT_FALSE(extrapolated_limit(on_parabola(1.5e-6), on_parabola(2.6e-6), on_parabola(3.3e-6), 1));
}

TEST(LimitPoint, NeedsVolumesThatDiffer) {
  const PathPoint point = on_parabola(1.0e-6);
  EXPECT_FALSE(extrapolated_limit(point, point, point, 1));
  EXPECT_FALSE(pressure_extremum(point, point, point, 1));
}

}  // namespace
}  // namespace menger::fem
