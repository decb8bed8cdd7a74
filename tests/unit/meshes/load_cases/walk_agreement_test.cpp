#include "meshes/load_cases/walk_agreement.h"

#include <gtest/gtest.h>

namespace menger::meshes {
namespace {

TEST(WalkAgreement, ComparesDirectionsTheShortWayRound) {
  EXPECT_DOUBLE_EQ(angle_between_directions_deg(170.0, -170.0), 20.0);
  EXPECT_DOUBLE_EQ(angle_between_directions_deg(-90.0, 90.0), 180.0);
  EXPECT_EQ(compare_walks({1.0, 5.0, 170.0}, {1.0, 5.0, -170.0}), WalkAgreement::alike);
  EXPECT_EQ(compare_walks({1.0, 5.0, 0.0}, {1.0, 5.0, 46.0}), WalkAgreement::different);
  EXPECT_EQ(compare_walks({1.0, 5.0, 0.0}, {1.0, 5.0}), WalkAgreement::alike) << "a direction that is not known does not differ";
}

TEST(WalkAgreement, ComparesSpeedsAndNotDistances) {
  EXPECT_EQ(compare_walks({1.0, 5.0, 0.0}, {2.0, 10.0, 0.0}), WalkAgreement::alike);
  EXPECT_EQ(compare_walks({1.0, 5.0, 0.0}, {1.6, 5.0, 0.0}), WalkAgreement::same_direction);
  EXPECT_EQ(compare_walks({1.6, 5.0, 0.0}, {1.0, 5.0, 0.0}), WalkAgreement::same_direction);
  EXPECT_EQ(compare_walks({0.17, 5.0, 0.0}, {2.3, 5.0, 0.0}), WalkAgreement::different) << "one hops once, the other walks";
}

TEST(WalkAgreement, GivesNoDirectionToWhatGoesNowhere) {
  EXPECT_EQ(compare_walks({0.02, 5.0, 0.0}, {0.04, 5.0, 180.0}), WalkAgreement::both_go_nowhere);
  EXPECT_EQ(compare_walks({0.02, 5.0, 0.0}, {0.4, 5.0, 0.0}), WalkAgreement::one_goes_nowhere);
}

TEST(WalkAgreement, TakesAFewStepsForNoDifferenceInTime) {
  EXPECT_TRUE(last_as_long(5.0, 5.00004));
  EXPECT_FALSE(last_as_long(2.0, 5.0));
  EXPECT_FALSE(last_as_long(5.0, 2.0));
}

TEST(WalkAgreement, TitlesThePictureOfAWalk) {
  EXPECT_EQ(moved_text("table", 5.0, 0.0142, -0.00031), "table after 5 s: its centre moved by x = 14.20 mm, y = -0.31 mm");
  EXPECT_EQ(moved_text("table", 5.0, -1e-6, 0.0), "table after 5 s: its centre moved by x = 0.00 mm, y = 0.00 mm");
}

}  // namespace
}  // namespace menger::meshes
