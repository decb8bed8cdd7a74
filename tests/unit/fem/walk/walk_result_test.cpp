#include "fem/walk/walk_result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace menger::fem {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// A walk of four periods of 1 s with records every half a second, which leans at the end of each by these angles about y.
WalkResult leaning(const std::vector<double>& angles_deg) {
  WalkResult result;
  result.records.push_back({.time_s = 0.0});
  for (std::size_t n = 0; n < angles_deg.size(); ++n) {
    WalkRecord middle{.time_s = static_cast<double>(n) + 0.5};
    middle.upright = {1.0, 0.0, 0.0};  // deformed by the drive
    WalkRecord end{.time_s = static_cast<double>(n) + 1.0};
    end.upright = {std::sin(angles_deg[n] * degree), 0.0, std::cos(angles_deg[n] * degree)};
    result.records.push_back(middle);
    result.records.push_back(end);
  }
  return result;
}

TEST(LargestLean, IsThatFromTheEndOfTheFirstPeriod) {
  const meshes::Lean lean = largest_lean(leaning({20.0, 25.0, -40.0, 0.0}), 1.0);
  EXPECT_NEAR(lean.angle_deg, 60.0, 1e-9);
  EXPECT_EQ(lean.period, 3U);
  EXPECT_NEAR(largest_lean(leaning({80.0, 80.0, 80.0}), 1.0).angle_deg, 0.0, 1e-6) << "it fell before the first period ended";
  EXPECT_NEAR(largest_lean(leaning({0.0, 180.0}), 1.0).angle_deg, 180.0, 1e-6);
  EXPECT_EQ(largest_lean(leaning({70.0}), 1.0).angle_deg, 0.0) << "one period alone tells nothing";
  EXPECT_EQ(largest_lean(WalkResult{}, 1.0).angle_deg, 0.0);
}

TEST(LargestLean, IsInfiniteWhereAnAxisIsNotANumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const meshes::Lean lean = largest_lean(leaning({20.0, 25.0, none, 30.0}), 1.0);
  EXPECT_EQ(lean.angle_deg, std::numeric_limits<double>::infinity());
  EXPECT_EQ(lean.period, 3U);
  EXPECT_EQ(largest_lean(leaning({none, 25.0}), 1.0).angle_deg, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace menger::fem
