#include "io/shown/shown_column.h"

#include <gtest/gtest.h>

#include <numbers>

namespace menger::io {
namespace {

TEST(ShownColumn, HasTheUnitOfItsName) {
  EXPECT_EQ(shown_column("plenum_0_pressure_Pa").title(), "plenum 0 pressure (kPa)");
  EXPECT_DOUBLE_EQ(shown_column("plenum_0_pressure_Pa").factor, 1e-3);
  EXPECT_EQ(shown_column("elements_body_lengths_per_minute").title(), "elements (body lengths / min)");
  EXPECT_EQ(shown_column("seconds").title(), "s");
  EXPECT_EQ(shown_column("status").title(), "status");
  EXPECT_EQ(shown_column("volume_m3").title(), "volume (cm\u00b3)");
}

TEST(ShownColumn, DisplacementsHaveWordsForSentences) {
  EXPECT_EQ(displacement_words("extent_y_m"), "the extent along y");
  EXPECT_EQ(displacement_words("top_m"), "the height of the top");
  EXPECT_EQ(displacement_words("foot_1_out_m"), "foot 1 out");
}

TEST(ShownColumn, HasTheUnitsOfFiguresForResponses) {
  EXPECT_EQ(shown_column("extent_x_m").title(), "extent x (mm)");
  EXPECT_EQ(shown_column("foot_1_out_m").quantity, "foot 1 out");
  EXPECT_EQ(shown_column("moment_N_m").title(), "moment (N mm)");
  EXPECT_EQ(shown_column("angle_rad").title(), "angle (degrees)");
  EXPECT_DOUBLE_EQ(shown_column("angle_rad").factor * std::numbers::pi, 180.0);
  EXPECT_EQ(shown_column("volume_change").title(), "volume change (%)");
  EXPECT_DOUBLE_EQ(shown_column("volume_change").factor, 100.0);
  EXPECT_EQ(shown_column("gravity_factor").title(), "gravity factor");
}

}  // namespace
}  // namespace menger::io
