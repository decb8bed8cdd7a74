#include "tests/unit/evolution/findings/robot_results.h"

namespace menger::evolution {
namespace {

using ShapeVerdict = RobotResults;

TEST_F(ShapeVerdict, SaysWhichPressuresWereComparedWhereACurveEndedEarly) {
  write_shape_error("0.3");
  write_validated("limit_point", "[500, 1000, 1500, 2000, 2500, 3000]", "500\n1000\n1500\n2000\n");
  const std::string some = "compared at 0.5 to 2 of 3 kPa, where the finite elements ended (no stable equilibrium follows)";
  expect_has(found("validate"), "(medians); " + some);
  expect_has(verdict(), "30 % off in displacements (medians); " + some + ". See");
  write_validated("wall_contact", "[-2000, -333, 333, 2000]", "333\n2000\n");
  expect_has(
      found("validate"),
      "; compared at 0.333 to 2 kPa, at no vacuum down to -2 kPa, where the finite elements ended (walls of a chamber touch)");
  write_shape_error("0.1");
  expect_has(verdict(),
             "The surrogate takes the shape of this body well: 10 % off in the median; compared at 0.333 to 2 kPa, at no vacuum");
  write_validated("completed", "[-2000, 2000]", "-2000\n2000\n");
  expect_has(verdict(), "The surrogate takes the shape of this body well: 10 % off in the median.");
}

TEST_F(ShapeVerdict, WarnsOfShapesThatTheSurrogateMisses) {
  const auto write = [&](const std::string& median, const std::string& wrong) {
    io::write_whole(folder_ / "validate/summary.csv",
                    "body,kind,range,median\nall,displacement,inside," + median + "\nall,volume,inside,0.05\n");
    io::write_whole(folder_ / "validate/signs.csv",
                    "body,observable,count,wrong\nrobot,extent_x_m,5," + wrong + "\nrobot,extent_y_m,5,0\n");
  };
  write("0.1", "0");
  expect_has(verdict(), "The surrogate takes the shape of this body well: 10 % off in the median.");
  EXPECT_EQ(found("validate"), "shape of this body: 10 % off in displacements, 5 % in chamber volume (medians)");
  io::write_whole(folder_ / "logs/validate.txt",
                  "summary\nnote: robot_inflation: the surrogate ends after 11 of 12 states (wall_contact, walls "
                  "meet)\nwall_contact: 1 curves\n");
  expect_has(found("validate"), "(medians); the surrogate ends after 11 of 12 states (wall_contact, walls meet)");
  write("0.1", "5");
  expect_has(verdict(),
             "Do not trust the surrogate's shape of this body: 10 % off in displacements, 5 % in chamber volume (medians); 5 of "
             "10 displacements of at least 0.2 mm go the wrong way (the extent along x). See validate/worst.png.");
  io::write_whole(folder_ / "validate/signs.csv",
                  "body,observable,range,count,wrong\nrobot,extent_x_m,inside,5,0\nrobot,extent_y_m,outside,6,6\n");
  expect_has(verdict(), "6 of 11 displacements of at least 0.2 mm go the wrong way (the extent along y)");
  io::write_whole(folder_ / "validate/signs.csv",
                  "body,observable,range,count,wrong\nrobot,extent_y_m,inside,6,6\nrobot,extent_y_m,outside,6,5\n");
  expect_has(verdict(), "11 of 12 displacements of at least 0.2 mm go the wrong way (the extent along y).");
  write("0.3", "0");
  expect_has(verdict(), "Do not trust the surrogate's shape of this body: 30 % off");
  io::write_whole(folder_ / "validate/summary.csv", "body,kind,range,median\nall,displacement,outside,0.05\n");
  expect_has(
      verdict(),
      "The surrogate takes the shape of this body well: 5 % off in the median; all that was compared lies outside what the fit "
      "covers.");
  robot_.drive = meshes::RobotDrive::antiphase;
  expect_has(verdict(), "well with all its chambers at one pressure, which its drive never has: 5 % off");
  robot_.drive = meshes::RobotDrive::in_phase;
  io::write_whole(folder_ / "validate/summary.csv", "body,kind,range,median\nall,displacement,outside,0.25\n");
  expect_has(verdict(), "25 % off in displacements (medians), all outside what the fit covers. See validate/worst.png.");
}

TEST_F(ShapeVerdict, TellsErrorsInMillimetresBesideTheirShareOfACurve) {
  io::write_whole(folder_ / "validate/summary.csv",
                  "body,kind,range,median,percentile_90,worst,worst_observable,median_m,worst_m,furthest_observable,furthest_m,"
                  "furthest_error\nall,displacement,inside,0.21,1.99,2.67,extent_y_m,0.00068,0.00108,top_m,0.00207,0.25\n"
                  "all,volume,inside,0.05,0.05,0.05,volume_change,,,,,\n");
  io::write_whole(folder_ / "validate/signs.csv", "body,observable,count,wrong\nrobot,extent_x_m,5,0\n");
  EXPECT_EQ(
      found("validate"),
      "shape of this body: 21 % (0.68 mm) off in displacements, 5 % in chamber volume (medians), furthest off by 2.07 mm, in "
      "the height of the top");
  expect_has(verdict(),
             "21 % (0.68 mm) off in displacements, 5 % in chamber volume (medians), furthest off by 2.07 mm, in the "
             "height of the top. See");
}

TEST_F(ShapeVerdict, CountsErrorsBeyondTheRangeOfTheParameters) {
  io::write_whole(folder_ / "validate/summary.csv",
                  "body,kind,range,median\nall,displacement,inside,0.1\nall,displacement,outside,0.4\nall,volume,inside,0.05\n");
  io::write_whole(folder_ / "validate/signs.csv", "body,observable,count,wrong\nrobot,extent_x_m,5,0\n");
  expect_has(verdict(),
             "Do not trust the surrogate's shape of this body: 10 % off in displacements, 5 % in chamber volume (medians); 40 % "
             "outside what the fit covers. See");
  EXPECT_EQ(found("validate"),
            "shape of this body: 10 % off in displacements, 5 % in chamber volume (medians); 40 % outside what the fit covers");
}

TEST_F(ShapeVerdict, WarnsOfVolumesThatTheSurrogateMisses) {
  const auto write = [&](const std::string& rows) {
    io::write_whole(folder_ / "validate/summary.csv", "body,kind,range,median\nall,displacement,inside,0.1\n" + rows);
    io::write_whole(folder_ / "validate/signs.csv", "body,observable,count,wrong\nrobot,extent_x_m,5,0\n");
  };
  write("all,volume,inside,0.15\n");
  expect_has(verdict(), "The surrogate takes the shape of this body well: 10 % off in the median.");
  write("all,volume,inside,0.16\n");
  expect_has(verdict(),
             "Do not trust the surrogate's shape of this body: 10 % off in displacements, 16 % in chamber volume (medians). See");
  write("all,volume,inside,0.05\nall,displacement,outside,0.1\nall,volume,outside,0.3\n");
  expect_has(verdict(), "5 % in chamber volume (medians); 10 %, 30 % outside what the fit covers. See");
}

}  // namespace
}  // namespace menger::evolution
