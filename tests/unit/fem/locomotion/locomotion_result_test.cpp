#include "fem/locomotion/locomotion_result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "io/text/toml_document.h"

namespace menger::fem {
namespace {

/// A body of 30 mm on a ground at -5 mm whose centre goes from (0, 0, 10) mm by (-3, 3, 1) mm in half a second, over a bump.
LocomotionResult walk() {
  LocomotionResult result;
  result.status = io::RunStatus::completed;
  result.time_s = 0.5;
  result.body_length_m = 0.03;
  result.ground_height_m = -0.005;
  result.plenum_names = {"plenum 0"};
  result.chamber_names = {"chamber 0"};
  result.records = {{.time_s = 0.0, .centre_of_mass_m = {0.0, 0.0, 0.010}},
                    {.time_s = 0.25, .centre_of_mass_m = {-0.001, 0.0, 0.013}},
                    {.time_s = 0.5, .centre_of_mass_m = {-0.003, 0.003, 0.011}}};
  for (WalkRecord& record : result.records) {
    record.plenum_pressures_Pa = {1000.0 * record.time_s};
    record.chamber_volumes_m3 = {1e-6};
  }
  return result;
}

TEST(LocomotionResult, TellsHowFarAndWhereTo) {
  const auto travel = travel_of(walk());
  ASSERT_TRUE(travel);
  EXPECT_NEAR(travel->horizontal_displacement_m, 0.003 * std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(travel->horizontal_displacement_body_lengths, 0.1 * std::sqrt(2.0), 1e-13);
  EXPECT_NEAR(travel->body_lengths_per_minute, 12.0 * std::sqrt(2.0), 1e-11);
  EXPECT_NEAR(travel->direction_deg, 135.0, 1e-12);
  EXPECT_NEAR(peak_height_m(walk()), 0.018, 1e-15);
}

TEST(LocomotionResult, ComparesNoRunThatDidNotComplete) {
  LocomotionResult result = walk();
  result.status = io::RunStatus::diverged;
  result.reason = "ran \"away\"";
  EXPECT_FALSE(travel_of(result));
  const io::TomlTable table = io::parse_toml(result_text(result), "locomotion.toml");
  EXPECT_EQ(table.text("status"), "diverged");
  EXPECT_EQ(table.text("reason"), "ran \"away\"");
  EXPECT_FALSE(table.has("displacement_m"));
  EXPECT_FALSE(table.has("body_lengths_per_minute"));
}

TEST(LocomotionResult, WritesWhatReadsBack) {
  const io::TomlTable table = io::parse_toml(result_text(walk()), "locomotion.toml");
  EXPECT_EQ(table.text("status"), "completed");
  EXPECT_EQ(table.numbers("displacement_m")[0], -0.003);
  EXPECT_EQ(table.number("peak_height_m"), peak_height_m(walk()));
  const io::CsvContents csv = io::parse_csv(trajectory_table(walk()).text(), "trajectory.csv");
  ASSERT_EQ(csv.row_count(), 3U);
  EXPECT_EQ(csv.number(2, "centre_of_mass_y_m"), 0.003);
  EXPECT_EQ(csv.number(1, "plenum_0_pressure_Pa"), 250.0);
  EXPECT_EQ(csv.number(1, "chamber_0_volume_m3"), 1e-6);
  EXPECT_NEAR(csv.number(2, "horizontal_displacement_body_lengths"), 0.1 * std::sqrt(2.0), 1e-13);
}

}  // namespace
}  // namespace menger::fem
