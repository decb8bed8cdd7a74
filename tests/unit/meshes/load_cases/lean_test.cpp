#include "meshes/load_cases/lean.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace menger::meshes {
namespace {

std::array<double, 3> leaning(double angle_deg, double towards_deg = 0.0) {
  const double angle = angle_deg * std::numbers::pi / 180.0;
  const double towards = towards_deg * std::numbers::pi / 180.0;
  return {std::sin(angle) * std::cos(towards), std::sin(angle) * std::sin(towards), std::cos(angle)};
}

TEST(Lean, AnglesAreExactNearNoneAndNearAHalfTurn) {
  EXPECT_NEAR(angle_between_deg(leaning(0.0), leaning(1e-6)), 1e-6, 1e-15);
  EXPECT_NEAR(angle_between_deg(leaning(0.0), leaning(180.0 - 1e-6)), 180.0 - 1e-6, 1e-10);
  EXPECT_NEAR(angle_between_deg(leaning(30.0), leaning(40.0, 180.0)), 70.0, 1e-12) << "of their heights it would be 10";
  EXPECT_TRUE(std::isnan(angle_between_deg(leaning(0.0), {std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0})));
}

TEST(Lean, IsTheLargestFromTheEndOfTheFirstPeriodOn) {
  const std::vector axes{leaning(20.0), leaning(25.0), leaning(40.0, 180.0), leaning(0.0)};
  const Lean lean = largest_lean(axes);
  EXPECT_NEAR(lean.angle_deg, 60.0, 1e-12);
  EXPECT_EQ(lean.period, 3U);
  EXPECT_EQ(largest_lean(std::vector{leaning(70.0)}).angle_deg, 0.0) << "one period alone tells nothing";
  EXPECT_EQ(largest_lean({}).angle_deg, 0.0);
}

TEST(Lean, IsInfiniteAtAnAxisThatIsNoNumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Lean lean = largest_lean(std::vector{leaning(0.0), leaning(90.0), std::array{none, none, none}, leaning(0.0)});
  EXPECT_TRUE(std::isinf(lean.angle_deg));
  EXPECT_EQ(lean.period, 3U);
}

}  // namespace
}  // namespace menger::meshes
