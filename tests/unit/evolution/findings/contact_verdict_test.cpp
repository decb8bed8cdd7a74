#include "evolution/findings/contact_verdict.h"

#include "tests/unit/evolution/findings/robot_results.h"

namespace menger::evolution {
namespace {

using ContactVerdict = RobotResults;

TEST_F(ContactVerdict, SaysWhatToDoWhereWallsTouchInAVacuum) {
  take_robot("111", "[drive]\npressure_Pa = [-4000, 0]\n");
  write_inflation("wall_contact");
  const auto touch_at = [&](const std::string& pressure) {
    io::write_whole(folder_ / "inflate/curves.csv",
                    "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n0,0,1e-6\n1," + pressure + ",0.5e-6\n");
  };
  touch_at("-500");
  expect_has(
      verdict(),
      "Walls of a chamber touch at -0.5 kPa by thin walls (inflate), before the -4 kPa of its drive. Shapes beyond are not");
  expect_has(verdict(), "Raise the lowest drive.pressure_Pa to -400 Pa or more.");
  EXPECT_EQ(early_contact(folder_, robot_), "walls of a chamber touch at -0.5 kPa, before the first state that it compares");
  touch_at("-700");
  EXPECT_EQ(early_contact(folder_, robot_), "") << "the first of six states is at -667 Pa";
}

TEST_F(ContactVerdict, TakesTheEarlierContactOfBothElements) {
  take_robot("111", "[drive]\npressure_Pa = [-900, 0]\n");
  const std::string head = "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n";
  write_inflation("completed");
  io::write_whole(folder_ / "inflate/curves.csv", head + "0,0,1e-6\n1,-900,0.6e-6\n");
  write_validated("wall_contact", "[-900, -750, -600, -450, -300, -150]", "-600\n-450\n-300\n-150\n");
  EXPECT_EQ(
      verdict(),
      "Walls of a chamber touch between -0.6 kPa and -0.75 kPa by quadratic elements (validate), before the -0.9 kPa of its "
      "drive; thin walls (inflate) come to -0.9 kPa without. Shapes beyond are not sure, nor are walks, whose walls press on "
      "each other. Raise the lowest drive.pressure_Pa to -480 Pa or more.");
  write_inflation("wall_contact");
  io::write_whole(folder_ / "inflate/curves.csv", head + "0,0,1e-6\n1,-500,0.6e-6\n");
  expect_has(verdict(), "touch at -0.5 kPa by thin walls (inflate), between -0.6 kPa and -0.75 kPa by quadratic elements");
  expect_has(verdict(), "to -400 Pa or more.");
  write_validated("wall_contact", "[-900, -750, -600, -450, -300, -150]", "");
  expect_has(verdict(), "between rest and -0.15 kPa by quadratic elements");
  expect_has(verdict(), "Raise the lowest drive.pressure_Pa well above -150 Pa.");
  stages_.erase("validate");
  expect_has(verdict(), "to -400 Pa or more.");
}

TEST_F(ContactVerdict, NamesTheLowestPressureOfADriveWhoseWallsTouchInVacuum) {
  take_robot("122", "chambers = \"per-phase\"\n[drive]\nmode = \"antiphase\"\npressure_Pa = [-2000, 2000]\n");
  write_inflation("wall_contact");
  io::write_whole(folder_ / "inflate/curves.csv",
                  "step,plenum_0_pressure_Pa,plenum_0_volume_m3,plenum_1_pressure_Pa,plenum_1_volume_m3\n0,0,1e-6,0,2e-6\n"
                  "1,-534.4,0.7e-6,534.4,2.2e-6\n");
  expect_has(verdict(),
             "Walls of a chamber touch at -0.534 kPa in the chambers of one material by thin walls (inflate), before the -2 kPa "
             "of its drive.");
  expect_has(verdict(), "Raise the lowest drive.pressure_Pa to -427 Pa or more.");
}

TEST_F(ContactVerdict, TellsOfVacuum) {
  robot_.pressure_Pa = {-6000.0, 0.0};
  stages_.erase("limit");
  write_inflation("completed");
  const std::string head = "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n";
  io::write_whole(folder_ / "inflate/curves.csv", head + "0,0,1e-6\n1,-6000,0.8e-6\n2,0,1e-6\n");
  EXPECT_EQ(found("inflate"), "at -6 kPa it holds 20 % less air");
  EXPECT_EQ(verdict(), "Down to -6 kPa no walls of a chamber touch.");
  write_inflation("wall_contact");
  io::write_whole(folder_ / "inflate/curves.csv", head + "0,0,1e-6\n1,-926,0.9e-6\n");
  expect_has(verdict(),
             "Walls of a chamber touch at -0.926 kPa by thin walls (inflate), before the -6 kPa of its drive. Shapes beyond");
}

}  // namespace
}  // namespace menger::evolution
