#include "tests/verification/voxel_trajectories.h"

#include <gtest/gtest.h>

namespace menger::voxel {
namespace {

TEST(VoxelTrajectories, ShortCasesMatchThePublicEngine) { expect_within_tolerance(DampingMode::increments, is_short); }

TEST(VoxelTrajectories, DampingFromVelocitiesMatchesShortCasesAtSmallSteps) {
  expect_within_tolerance(DampingMode::velocity, [](const TrajectoryCase& c) { return c.fraction < 0.1 && is_short(c); });
}

TEST(VoxelTrajectories, SinglePrecisionHoldsShortCases) { expect_float_within_tolerance(is_short); }

TEST(VoxelTrajectories, ExactRestLengthsMissOneSlipOfThePublicEngine) {
  int found = 0;
  for (const TrajectoryCase& c : cases()) {
    if (!slips_by_rounding(c)) continue;
    ++found;
    EXPECT_NEAR(distance(displacement_m(c, reference_physics(c, DampingMode::increments)), c.displacement_m), 5.9e-5, 5e-6);
  }
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace menger::voxel
