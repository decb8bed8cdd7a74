#include "fem/statics/path_drives.h"

#include <gtest/gtest.h>

#include <vector>

namespace menger::fem {
namespace {

const PathDrives drives{.plena = {{.values = {0.0, 1000.0, 1000.0, -500.0}}, {.kind = DriveKind::volume, .values = {1.0, 2.0}}},
                        .dead_load_factors = {}};

TEST(PathDrives, AreLinearBetweenKnotsAndStayAtTheirEnds) {
  const PathSchedule schedule(drives);
  EXPECT_EQ(schedule.end(), 3.0);
  EXPECT_EQ(schedule.value_at(0, 0.25), 250.0);
  EXPECT_EQ(schedule.value_at(0, 2.5), 250.0);
  EXPECT_EQ(schedule.value_at(0, 3.0), -500.0);
  EXPECT_EQ(schedule.value_at(1, 2.5), 2.0) << "after its last knot";
  const std::vector<double> rest_volumes_m3{1e-6, 3e-6};
  const std::vector<PlenumControl> controls = schedule.controls_at(0.5, rest_volumes_m3);
  ASSERT_EQ(controls.size(), 2U);
  EXPECT_EQ(std::get<PressureControl>(controls[0]).pressure_Pa, 500.0);
  EXPECT_DOUBLE_EQ(std::get<VolumeControl>(controls[1]).volume_m3, 4.5e-6);
}

TEST(PathDrives, KnowWhichLegDrivesWhichPlenum) {
  const PathSchedule schedule(drives);
  EXPECT_TRUE(schedule.is_driven(0, 0.0));
  EXPECT_FALSE(schedule.is_driven(0, 1.0)) << "at a knot the leg that begins there counts";
  EXPECT_TRUE(schedule.is_driven(0, 2.0));
  EXPECT_FALSE(schedule.is_driven(0, 3.0)) << "nothing begins at the end";
  EXPECT_TRUE(schedule.is_driven(1, 0.5));
  EXPECT_FALSE(schedule.any_is_driven(1.5));
  EXPECT_FALSE(schedule.all_given_pressures());
  EXPECT_TRUE(schedule.is_given_pressure(0));
  const PathDrives pressures{.plena = {{.values = {0.0, 10.0}}, {.values = {0.0, -20.0}}}};
  EXPECT_EQ(PathSchedule(pressures).fastest_plenum(0.0, 0.1), 1U);
  EXPECT_TRUE(PathSchedule(pressures).all_given_pressures());
}

TEST(PathDrives, DeadLoadsGrowBeforeThePathUnlessTheyHaveKnots) {
  const PathSchedule before(drives);
  EXPECT_EQ(before.dead_load_factor_at(-1.0), 0.0);
  EXPECT_EQ(before.dead_load_factor_at(-0.25), 0.75);
  EXPECT_EQ(before.dead_load_factor_at(2.0), 1.0);
  const PathDrives own{.dead_load_factors = {1.0, 3.0}};
  const PathSchedule along(own);
  EXPECT_EQ(along.dead_load_factor_at(0.5), 2.0);
  EXPECT_EQ(along.end(), 1.0);
}

TEST(PathDrives, NextStationsAreKnotsAndWhatIsAskedFor) {
  const PathSchedule schedule(drives);
  const std::vector<double> stations{0.5, 1.25};
  EXPECT_EQ(schedule.next_station(-1.0, {}), 0.0);
  EXPECT_EQ(schedule.next_station(0.0, stations), 0.5);
  EXPECT_EQ(schedule.next_station(0.5, stations), 1.0);
  EXPECT_EQ(schedule.next_station(1.0, stations), 1.25);
  EXPECT_EQ(schedule.next_station(2.9, stations), 3.0);
  EXPECT_TRUE(is_knot(2.0));
  EXPECT_FALSE(is_knot(2.1));
}

}  // namespace
}  // namespace menger::fem
