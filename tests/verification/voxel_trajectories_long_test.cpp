#include <gtest/gtest.h>

#include "tests/verification/voxel_trajectories.h"

namespace menger::voxel {
namespace {

TEST(VoxelTrajectoriesLong, LongCasesMatchThePublicEngine) {
  expect_within_tolerance(DampingMode::increments, [](const TrajectoryCase& c) { return !is_short(c); });
}

TEST(VoxelTrajectoriesLong, DampingFromVelocitiesMatchesLongCasesAtSmallSteps) {
  expect_within_tolerance(DampingMode::velocity, [](const TrajectoryCase& c) { return c.fraction < 0.1 && !is_short(c); });
}

TEST(VoxelTrajectoriesLong, SinglePrecisionHoldsLongCases) {
  expect_float_within_tolerance([](const TrajectoryCase& c) { return !is_short(c); });
}

}  // namespace
}  // namespace menger::voxel
