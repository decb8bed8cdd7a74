#include "evolution/loop/loop_findings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/text/joined_text.h"
#include "io/text/whole_file.h"
#include "meshes/robot/robot_file.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

class LoopFindings : public testing::Test {
 protected:
  LoopFindings() {
    io::write_whole(
        folder_ / "robot.toml",
        "[robot]\nlayers = [[\"111\"]]\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n[drive]\npressure_Pa = [0, 3000]\n");
    robot_ = meshes::read_robot(folder_ / "robot.toml");
  }

  void write_walk(const std::string& file, double x_m, double y_m, const std::string& lengths = "0.5") const {
    io::write_whole(folder_ / file, "status = \"completed\"\ntime_s = 5.0\ndisplacement_m = [" + std::to_string(x_m) + ", " +
                                        std::to_string(y_m) + ", 0.001]\nhorizontal_displacement_body_lengths = " + lengths +
                                        "\n");
  }

  /// Writes the frames of a walk: a cell that leans by some angle at the end of each stroke of a third of a second.
  void leave_frames(const std::string& stage, const std::vector<double>& leans_deg) const {
    std::string collection = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (std::size_t n = 0; n <= 2 * leans_deg.size(); ++n) {
      const double lean = (n == 0 ? 0.0 : leans_deg[(n - 1) / 2]) * std::numbers::pi / 180.0;
      std::string points;
      std::string moved;
      for (const double z : {0.0, 1.0}) {
        for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
          points += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + " ";
          moved += std::to_string(x * std::cos(lean) + z * std::sin(lean) - x) + " 0 " +
                   std::to_string(z * std::cos(lean) - x * std::sin(lean) - z) + " ";
        }
      }
      const std::string name = "frame_" + std::to_string(n) + ".vtu";
      io::write_whole(
          folder_ / stage / name,
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<UnstructuredGrid>\n<Piece "
          "NumberOfPoints=\"8\" NumberOfCells=\"1\">\n<PointData>\n<DataArray type=\"Float64\" "
          "Name=\"displacement_m\" NumberOfComponents=\"3\" format=\"ascii\">" +
              moved +
              "</DataArray>\n</PointData>\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" "
              "format=\"ascii\">" +
              points +
              "</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 "
              "2 3 4 5 6 7</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" "
              "format=\"ascii\">8</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" "
              "format=\"ascii\">12</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
      collection +=
          "<DataSet timestep=\"" + std::to_string(static_cast<double>(n) / 6.0) + "\" part=\"0\" file=\"" + name + "\"/>\n";
    }
    io::write_whole(folder_ / stage / "frames.pvd", collection + "</Collection>\n</VTKFile>\n");
  }

  void write_early_walk(const std::string& file, double x_m) const {
    io::write_whole(folder_ / file, "status = \"diverged\"\nreason = \"too fast\"\ntime_s = 0.4\ndisplacement_m = [" +
                                        std::to_string(x_m) + ", 0, 0]\nhorizontal_displacement_body_lengths = 0.5\n");
  }

  /// Makes the robot a row of cells. @param more keys that follow those of its cells
  void take_robot(const std::string& row, const std::string& more) {
    io::write_whole(folder_ / "robot.toml",
                    "[robot]\nlayers = [[\"" + row + "\"]]\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n" + more);
    robot_ = meshes::read_robot(folder_ / "robot.toml");
  }
  void write_inflation(const std::string& status) const {
    io::write_whole(folder_ / "inflate/result.toml", "status = \"" + status + "\"\n");
  }

  void write_limit(const std::string& pressure_Pa) const {
    io::write_whole(folder_ / "limit/result.toml",
                    "status = \"completed\"\n[[limit_points]]\nplenum = \"plenum 0\"\npressure_Pa = " + pressure_Pa + "\n");
  }

  /// Writes the inflation of the stage validate, in which each number is a pressure.
  void write_validated(const std::string& status, const std::string& missed, const std::string& planned,
                       const std::string& compared_rows) const {
    io::write_whole(folder_ / "validate/curves/robot_inflation.toml",
                    "status = \"" + status + "\"\nreason = \"pressure_Pa = " + missed +
                        " was not reached: it ended\"\n[case]\npressures_Pa = " + planned + "\n");
    io::write_whole(folder_ / "validate/curves/robot_inflation.csv", "pressure_Pa\n" + compared_rows);
  }

  /// Writes how far the surrogate is off in the shape of the robot, in the median of its displacements.
  void write_shape_error(const std::string& median) const {
    io::write_whole(folder_ / "validate/summary.csv", "body,kind,range,median\nall,displacement,inside," + median + "\n");
    io::write_whole(folder_ / "validate/signs.csv", "body,observable,count,wrong\nrobot,extent_x_m,5,0\n");
  }

  [[nodiscard]] std::string found(const std::string& stage) const { return stage_finding(stage, folder_, robot_); }
  [[nodiscard]] std::string verdict() const { return io::joined(loop_verdict(folder_, robot_, stages_), "\n"); }

  tests::TestFolder folder_;
  meshes::Robot robot_;
  std::set<std::string> stages_{"inflate", "limit", "validate", "simulate", "locomote", "locomote_finer"};
};

const std::string too_high = " by these elements, which put it 6 to 12 % too high; the drive of 3 kPa is ";

void expect_has(const std::string& text, const std::string& part) { EXPECT_NE(text.find(part), std::string::npos) << text; }

TEST_F(LoopFindings, TellWhatTheFilesOfAStageHold) {
  write_walk("simulate/result.toml", 0.03, 0.04);
  EXPECT_EQ(found("simulate"), "it moves 50 mm (0.5 body lengths) in 5 s");
  io::write_whole(folder_ / "locomote/locomotion.toml", "status = \"diverged\"\nreason = \"too fast\"\n");
  EXPECT_EQ(found("locomote"), "diverged: too fast");
  write_limit("12000.0");
  EXPECT_EQ(found("limit"), "it balloons at 12 kPa" + too_high + "25 % of that");
  io::write_whole(folder_ / "inflate/result.toml", "status = \"completed\"\n");
  io::write_whole(folder_ / "inflate/curves.csv", "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n0,0,1e-6\n1,3000,1.5e-6\n");
  EXPECT_EQ(found("inflate"), "at 3 kPa it holds 50 % more air");
  robot_.drive = meshes::RobotDrive::antiphase;
  io::write_whole(folder_ / "inflate/curves.csv",
                  "step,plenum_0_pressure_Pa,plenum_0_volume_m3,plenum_1_pressure_Pa,plenum_1_volume_m3\n0,0,1e-6,0,2e-6\n"
                  "1,3000,1.5e-6,0,2e-6\n2,0,1e-6,3000,2.4e-6\n");
  EXPECT_EQ(found("inflate"), "at 3 kPa in the chambers of one material each of these holds 20 to 50 % more air");
  robot_.drive = meshes::RobotDrive::in_phase;
  io::write_whole(folder_ / "mesh/mesh_quality.csv",
                  "quantity,value\nelements,3\nsolid volume_m3,2e-6\nchamber 0 volume_m3,1e-6\nchamber 1 volume_m3,1e-6\n");
  EXPECT_EQ(found("mesh"), "2 cm3 of silicone around 2 cm3 of air");
}

TEST_F(LoopFindings, AreEmptyForResultsThatTheyCannotRead) {
  EXPECT_EQ(found("simulate"), "");
  io::write_whole(folder_ / "simulate/result.toml", "status = ");
  EXPECT_EQ(found("simulate"), "");
}

TEST_F(LoopFindings, VerdictSaysWhetherTheBodyBearsItsPressure) {
  write_inflation("completed");
  write_limit("12000.0");
  // 12 kPa of thin walls may be 12 / 1.12 = 10.7 kPa, of which 80 % are safe.
  expect_has(verdict(),
             "It bears its pressure of 3 kPa: safe up to 8.57 kPa, 20 % below the 10.7 kPa to 11.3 kPa at which it balloons.\n");
  expect_has(verdict(),
             "By the softest law of its silicone (ogden1, Soft Robotics Materials Database, law_variant = 1) it is safe, too, up "
             "to 3.98 kPa.");
  // The softest law of Dragon Skin 10 has 0.46 times the shear modulus.
  EXPECT_NEAR(softest_limit_Pa(folder_, robot_).value(), 0.464 * 12000.0 / 1.12, 5.0);
  write_limit("8000.0");
  expect_has(
      verdict(),
      "It bears its pressure of 3 kPa by its law (neo_hookean, modulus at 100 % strain of the data sheet divided by 1.75), "
      "hardly by the softest of its silicone: safe up to 5.71 kPa");
  expect_has(verdict(),
             "By the softest law of its silicone (ogden1, Soft Robotics Materials Database, law_variant = 1) it is near "
             "ballooning, 91 % of 3.31 kPa: test the silicone that you cast, or lower drive.pressure_Pa to 2650 Pa or less.");
  write_limit("6000.0");
  expect_has(verdict(), "not by the softest of its silicone: safe up to 4.29 kPa");
  expect_has(verdict(), "it balloons near 2.49 kPa: test the silicone");
  write_limit("3500.0");
  expect_has(verdict(),
             "Its pressure of 3 kPa is near that at which it balloons, 3.12 kPa to 3.3 kPa: lower drive.pressure_Pa to 2500 Pa "
             "or less.");
  expect_has(verdict(),
             "balloons near 1.45 kPa: test the silicone that you cast, or lower drive.pressure_Pa to 1160 Pa or less.");
  write_limit("2500.0");
  expect_has(verdict(),
             "It balloons at 2.23 kPa to 2.36 kPa, before the 3 kPa of its drive: lower drive.pressure_Pa to 1780 Pa or less.");
}

TEST_F(LoopFindings, SayWhatToDoWhereWallsTouchInAVacuum) {
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

TEST_F(LoopFindings, VerdictTakesTheEarlierContactOfBothElements) {
  take_robot("111", "[drive]\npressure_Pa = [-900, 0]\n");
  const std::string head = "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n";
  write_inflation("completed");
  io::write_whole(folder_ / "inflate/curves.csv", head + "0,0,1e-6\n1,-900,0.6e-6\n");
  write_validated("wall_contact", "-750", "[-900, -750, -600, -450, -300, -150]", "-600\n-450\n-300\n-150\n");
  EXPECT_EQ(
      verdict(),
      "Walls of a chamber touch between -0.6 kPa and -0.75 kPa by quadratic elements (validate), before the -0.9 kPa of its "
      "drive; thin walls (inflate) come to -0.9 kPa without. Shapes beyond are not sure, nor are walks, whose walls press on "
      "each other. Raise the lowest drive.pressure_Pa to -480 Pa or more.");
  write_inflation("wall_contact");
  io::write_whole(folder_ / "inflate/curves.csv", head + "0,0,1e-6\n1,-500,0.6e-6\n");
  expect_has(verdict(), "touch at -0.5 kPa by thin walls (inflate), between -0.6 kPa and -0.75 kPa by quadratic elements");
  expect_has(verdict(), "to -400 Pa or more.");
  write_validated("wall_contact", "-150", "[-900, -750, -600, -450, -300, -150]", "");
  expect_has(verdict(), "between rest and -0.15 kPa by quadratic elements");
  expect_has(verdict(), "Raise the lowest drive.pressure_Pa well above -150 Pa.");
  stages_.erase("validate");
  expect_has(verdict(), "to -400 Pa or more.");
}

TEST_F(LoopFindings, VerdictNamesTheLowestPressureOfADriveWhoseWallsTouchInVacuum) {
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

TEST_F(LoopFindings, VerdictDoesNotSayThatABodyBearsWhatOtherElementsDoNot) {
  write_inflation("completed");
  write_limit("12000.0");
  write_validated("limit_point", "2500", "[500, 1000, 1500, 2000, 2500, 3000]", "500\n1000\n1500\n2000\n");
  expect_has(
      verdict(),
      "Whether it bears its pressure of 3 kPa is not known: quadratic elements (validate, free) lose their stable "
      "equilibrium between 2 kPa and 2.5 kPa, where a body buckles or balloons; thin walls (inflate, on the ground) see no "
      "such point below 10.7 kPa. To be safe by both, lower drive.pressure_Pa to 1600 Pa or less.");
  EXPECT_EQ(verdict().find("It bears"), std::string::npos) << verdict();
  stages_.erase("validate");
  expect_has(verdict(), "It bears its pressure of 3 kPa: safe up to 8.57 kPa");
}

TEST_F(LoopFindings, SayWhichPressuresWereComparedWhereACurveEndedEarly) {
  write_shape_error("0.3");
  write_validated("limit_point", "2500", "[500, 1000, 1500, 2000, 2500, 3000]", "500\n1000\n1500\n2000\n");
  const std::string some = "compared at 0.5 to 2 of 3 kPa, where the finite elements ended (no stable equilibrium follows)";
  expect_has(found("validate"), "(medians); " + some);
  expect_has(verdict(), "30 % off in the median; " + some + ". See");
  write_validated("wall_contact", "-333", "[-2000, -333, 333, 2000]", "333\n2000\n");
  expect_has(
      found("validate"),
      "; compared at 0.333 to 2 kPa, at no vacuum down to -2 kPa, where the finite elements ended (walls of a chamber touch)");
  write_shape_error("0.1");
  expect_has(verdict(), "The surrogate takes the shape of this body well, compared at 0.333 to 2 kPa, at no vacuum");
  write_validated("completed", "0", "[-2000, 2000]", "-2000\n2000\n");
  expect_has(verdict(), "The surrogate takes the shape of this body well.");
}

TEST_F(LoopFindings, VerdictSaysWhereFiniteElementsDiffer) {
  write_inflation("completed");
  io::write_whole(folder_ / "inflate/curves.csv", "step,plenum_0_pressure_Pa,plenum_0_volume_m3\n0,0,1e-6\n1,3000,1.5e-6\n");
  const auto write = [&](const std::string& change) {
    io::write_whole(folder_ / "validate/errors.csv",
                    "observable,pressure_Pa,finite_elements\nextent_x_m,3000,1e-4\nvolume_change,"
                    "1500,0.1\nvolume_change,3000," +
                        change + "\n");
  };
  write("0.52");
  EXPECT_EQ(verdict().find("is known to"), std::string::npos) << verdict();
  write("0.65");
  expect_has(verdict(),
             "At 3 kPa its chamber is known to 10 %: 1.50 times its volume at rest by thin walls (inflate, on the ground), 1.65 "
             "times by quadratic elements (validate, free). The ground holds the body back: part of the difference is that.");
  robot_.walks = false;
  expect_has(verdict(), "by thin walls (inflate), 1.65 times by quadratic elements (validate).");
  robot_.walks = true;
  write_inflation("not_converged");
  EXPECT_EQ(verdict().find("is known to"), std::string::npos) << "its last state has another pressure";
}

TEST_F(LoopFindings, VerdictKnowsTheLimitPressureFromTheLeastPressureAfterSnapThrough) {
  write_inflation("completed");
  io::write_whole(folder_ / "limit/result.toml",
                  "status = \"completed\"\n[[limit_points]]\nplenum = \"plenum 0\"\npressure_Pa = 12000\n[[limit_points]]\n"
                  "plenum = \"plenum 0\"\npressure_Pa = 2000\n");
  EXPECT_EQ(found("limit"), "it balloons at 12 kPa" + too_high + "25 % of that");
  expect_has(verdict(), "It bears its pressure of 3 kPa: safe up to 8.57 kPa");
}

TEST_F(LoopFindings, VerdictNeedsAnInflationUpToThePressureOfTheDrive) {
  write_limit("12000.0");
  EXPECT_EQ(verdict(), "");
  write_inflation("not_converged");
  EXPECT_EQ(verdict(), "Whether it bears its pressure is not known: its inflation ended before 3 kPa (not_converged).");
  write_inflation("completed");
  io::write_whole(folder_ / "limit/result.toml", "status = \"not_converged\"\n");
  io::write_whole(folder_ / "limit/curves.csv", "step,plenum_0_pressure_Pa\n0,0\n1,5000\n");
  expect_has(verdict(), "How far it is from ballooning is not known: no limit pressure was found up to 5 kPa; not_converged.");
}

TEST_F(LoopFindings, LimitIsTheLeastOfAllChambersAndOfTheInflation) {
  io::write_whole(folder_ / "limit/result.toml",
                  "status = \"completed\"\n[[limit_points]]\nplenum = \"plenum 1\"\npressure_Pa = 24000\n");
  EXPECT_EQ(found("limit"), "it balloons at 24 kPa" + too_high + "12 % of that");
  io::write_whole(folder_ / "inflate/result.toml",
                  "status = \"limit_point\"\n[[limit_points]]\nplenum = \"plenum 0\"\npressure_Pa = 2500\n");
  EXPECT_EQ(found("limit"), "it balloons at 2.5 kPa" + too_high + "120 % of that");
  expect_has(verdict(), "It balloons at 2.23 kPa to 2.36 kPa, before the 3 kPa of its drive");
}

TEST_F(LoopFindings, TellInWhichChambersADriveInAntiphaseHasItsPressure) {
  take_robot("122", "chambers = \"per-phase\"\n[drive]\nmode = \"antiphase\"\npressure_Pa = [0, 3000]\n");
  write_inflation("completed");
  const std::string head = "step,plenum_0_pressure_Pa,plenum_0_volume_m3,plenum_1_pressure_Pa,plenum_1_volume_m3\n";
  io::write_whole(folder_ / "inflate/curves.csv", head + "0,0,1e-6,0,2e-6\n1,3000,1.5e-6,0,1.8e-6\n2,0,0.9e-6,3000,3e-6\n");
  EXPECT_EQ(found("inflate"), "at 3 kPa in the chambers of one material each of these holds 50 % more air");
  write_inflation("wall_contact");
  io::write_whole(folder_ / "inflate/curves.csv", head + "0,0,1e-6,0,2e-6\n1,2600,1.5e-6,0,1.8e-6\n");
  EXPECT_EQ(found("inflate"), "walls of a chamber touch at 2.6 kPa in the chambers of one material");
  expect_has(
      verdict(),
      "Walls of a chamber touch at 2.6 kPa in the chambers of one material by thin walls (inflate), before the 3 kPa of its "
      "drive. ");
  write_limit("12000");
  expect_has(verdict(), "It bears its pressure of 3 kPa: safe up to 8.57 kPa");
}

TEST_F(LoopFindings, TellWhichRobotASearchFoundAndWhatItsElementsRefused) {
  io::write_whole(folder_ / "logs/evolve.txt",
                  "Champion: individual 3, 5 cells; number 2 of the search: 0.01\nNext: menger export\n");
  EXPECT_EQ(found("evolve"), "Champion: individual 3, 5 cells");
  io::write_whole(folder_ / "logs/evolve.txt",
                  "note: finite elements refused 2 of 11 bodies\nChampion: individual 3, 5 cells\nNext: menger export\n");
  EXPECT_EQ(found("evolve"), "Champion: individual 3, 5 cells; finite elements refused 2 of 11 bodies");
}

TEST_F(LoopFindings, TellOfVacuum) {
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

TEST_F(LoopFindings, VerdictReadsOnlyResultsOfStagesOfThisRobot) {
  write_inflation("completed");
  write_limit("12000.0");
  write_walk("simulate/result.toml", 0.04, 0.0);
  write_walk("locomote/locomotion.toml", 0.04, 0.0);
  write_walk("locomote_finer/locomotion.toml", 0.002, 0.0);
  stages_.erase("locomote_finer");  // as with the finest elements
  EXPECT_EQ(verdict().find("two meshes"), std::string::npos) << verdict();
  expect_has(verdict(), "The surrogate walks as finite elements do: 40 mm and 40 mm");
  stages_.erase("simulate");  // as after a fit that failed
  EXPECT_EQ(verdict().find("surrogate"), std::string::npos) << verdict();
  stages_ = {};
  EXPECT_EQ(verdict(), "");
}

TEST_F(LoopFindings, VerdictComparesNoWalkThatEndedEarly) {
  write_walk("simulate/result.toml", 0.04, 0.0);
  write_walk("locomote/locomotion.toml", 0.04, 0.0);
  write_early_walk("locomote_finer/locomotion.toml", 0.04);
  expect_has(verdict(), "The walk on finite elements of the finer mesh ended early and is not compared (diverged: too fast).");
  EXPECT_EQ(verdict().find("agree on the walk"), std::string::npos) << verdict();
  expect_has(verdict(), "The surrogate walks as finite elements do: 40 mm and 40 mm");
  write_early_walk("locomote/locomotion.toml", 0.04);
  EXPECT_EQ(verdict().find("The surrogate"), std::string::npos) << verdict();
}

TEST_F(LoopFindings, VerdictComparesWalksOfBothModelsAndOfBothMeshes) {
  write_walk("simulate/result.toml", 0.04, 0.0);
  write_walk("locomote/locomotion.toml", -0.006, 0.0);
  write_walk("locomote_finer/locomotion.toml", 0.024, 0.0);
  expect_has(verdict(), "How it walks is not known: 6 mm and 24 mm, 180 degrees apart on finite elements of two meshes.");
  expect_has(verdict(), "So the walk of the surrogate, 40 mm, cannot be judged.");
  EXPECT_EQ(verdict().find("The surrogate does not walk"), std::string::npos) << verdict();
  write_walk("locomote/locomotion.toml", 0.02, 0.0);
  write_walk("simulate/result.toml", 0.03, 0.0);
  expect_has(verdict(), "Finite elements of two meshes agree on the walk: 20 mm and 24 mm, 0 degrees apart.");
  expect_has(verdict(), "The surrogate walks as finite elements do: 30 mm and 24 mm");
  write_walk("simulate/result.toml", 0.0, 0.024);
  expect_has(verdict(), "The surrogate does not walk as finite elements do: 24 mm and 24 mm, 90 degrees apart");
}

TEST_F(LoopFindings, VerdictTellsADirectionThatIsKnownFromADistanceThatIsNot) {
  write_walk("locomote/locomotion.toml", -0.019, 0.0, "0.53");
  write_walk("locomote_finer/locomotion.toml", -0.030, 0.0, "0.85");
  write_walk("simulate/result.toml", -0.02, 0.0);
  expect_has(verdict(), "The direction of its walk is known, its distance is not: 19 mm and 30 mm, 0 degrees apart on finite");
  expect_has(verdict(), "The surrogate goes that way, too; its distance, 20 mm, cannot be judged.");
  write_walk("simulate/result.toml", 0.02, 0.0);
  expect_has(verdict(), "The surrogate does not walk as finite elements do: 20 mm and 30 mm, 180 degrees apart");
}

TEST_F(LoopFindings, VerdictBlamesSymmetryOnlyWhereABodyHasIt) {
  const std::string advice = "Chance decides such a walk; a body that differs from its mirror image walks more surely.";
  write_walk("locomote/locomotion.toml", -0.006, 0.0);
  write_walk("locomote_finer/locomotion.toml", 0.024, 0.0);
  expect_has(verdict(), advice);
  take_robot("122", "[drive]\npressure_Pa = [0, 3000]\n");
  expect_has(verdict(), advice);  // one chamber: materials drive nothing apart
  robot_.drive = meshes::RobotDrive::antiphase;
  expect_has(verdict(), "Chance decides such a walk.");
  robot_.drive = meshes::RobotDrive::in_phase;
  write_walk("locomote_finer/locomotion.toml", 0.0, 0.024);
  expect_has(verdict(), advice);
  io::write_whole(folder_ / "robot.toml",
                  "[robot]\nlayers = [[\"110\", \"111\"]]\ncell_edge_m = 0.01\nsilicone = \"dragon_skin_10\"\n");
  robot_ = meshes::read_robot(folder_ / "robot.toml");
  expect_has(verdict(), "Chance decides such a walk.");
}

TEST_F(LoopFindings, VerdictSaysOnWhichMeshABodyDoesNotWalk) {
  write_walk("locomote/locomotion.toml", 0.00431, 0.0, "0.12");
  write_walk("locomote_finer/locomotion.toml", 0.0027, 0.0, "0.075");
  expect_has(
      verdict(),
      "Whether it walks is not known: it moves 4.31 mm and 2.7 mm on finite elements of two meshes, and 2.7 mm is no walk.");
}

TEST_F(LoopFindings, TellAFallFromAWalk) {
  write_walk("simulate/result.toml", 0.037, 0.0);
  write_walk("locomote/locomotion.toml", 0.02, 0.0);
  write_walk("locomote_finer/locomotion.toml", 0.024, 0.0);
  leave_frames("simulate", {2.0, 3.0, 10.0});
  EXPECT_EQ(found("simulate"), "it moves 37 mm (0.5 body lengths) in 5 s");
  leave_frames("simulate", {2.0, 3.0, 80.0, 85.0});
  EXPECT_EQ(found("simulate"), "it moves 37 mm (0.5 body lengths) in 5 s, but fell over at 1 s: this is no walk");
  expect_has(verdict(), "The body fell over at 1 s in the walk of the surrogate: this is no walk.");
  expect_has(verdict(),
             "The surrogate does not walk as finite elements do: 37 mm and 24 mm, of which the first is a fall (surrogate and");
  leave_frames("locomote_finer", {2.0, 3.0, 80.0});
  expect_has(verdict(),
             "Whether it walks is not known: it moves 20 mm and 24 mm on finite elements of two meshes, and 24 mm is a fall.");
  leave_frames("locomote", {2.0, 90.0, 90.0});
  expect_has(verdict(), "It falls over on finite elements of two meshes: it does not walk.");
  io::write_whole(folder_ / "simulate/frame_0.vtu", "no grid");
  EXPECT_EQ(found("simulate"), "it moves 37 mm (0.5 body lengths) in 5 s") << "the walk is known without its frames";
}

TEST_F(LoopFindings, VerdictWarnsOfShapesThatTheSurrogateMisses) {
  const auto write = [&](const std::string& median, const std::string& wrong) {
    io::write_whole(folder_ / "validate/summary.csv",
                    "body,kind,range,median\nall,displacement,inside," + median + "\nall,volume,inside,0.05\n");
    io::write_whole(folder_ / "validate/signs.csv",
                    "body,observable,count,wrong\nrobot,extent_x_m,5," + wrong + "\nrobot,extent_y_m,5,0\n");
  };
  write("0.1", "0");
  expect_has(verdict(), "The surrogate takes the shape of this body well.");
  EXPECT_EQ(found("validate"), "shape of this body: 10 % off in displacements, 5 % in chamber volume (medians)");
  io::write_whole(folder_ / "logs/validate.txt",
                  "summary\nnote: robot_inflation: the surrogate ends after 11 of 12 states (wall_contact, walls "
                  "meet)\nwall_contact: 1 curves\n");
  expect_has(found("validate"), "(medians); the surrogate ends after 11 of 12 states (wall_contact, walls meet)");
  write("0.1", "5");
  expect_has(
      verdict(),
      "Do not trust the surrogate's shape of this body: 10 % off in the median; 5 of 10 displacements go the wrong way (the "
      "extent along x). See validate/worst.png.");
  write("0.3", "0");
  expect_has(verdict(), "Do not trust the surrogate's shape of this body: 30 % off");
  io::write_whole(folder_ / "validate/summary.csv", "body,kind,range,median\nall,displacement,outside,0.05\n");
  expect_has(verdict(), "5 % off in the median, all outside what the fit covers. See validate/worst.png.");
}

TEST_F(LoopFindings, TellErrorsOfTheShapeInMillimetresBesideTheirShareOfACurve) {
  io::write_whole(folder_ / "validate/summary.csv",
                  "body,kind,range,median,percentile_90,worst,worst_observable,median_m,worst_m,furthest_observable,furthest_m,"
                  "furthest_error\nall,displacement,inside,0.21,1.99,2.67,extent_y_m,0.00068,0.00108,top_m,0.00207,0.25\n"
                  "all,volume,inside,0.05,0.05,0.05,volume_change,,,,,\n");
  io::write_whole(folder_ / "validate/signs.csv", "body,observable,count,wrong\nrobot,extent_x_m,5,0\n");
  EXPECT_EQ(
      found("validate"),
      "shape of this body: 21 % (0.68 mm) off in displacements, 5 % in chamber volume (medians), furthest off by 2.07 mm, in "
      "the height of the top");
  expect_has(verdict(), "21 % (0.68 mm) off in the median; furthest off by 2.07 mm, in the height of the top. See");
}

TEST_F(LoopFindings, VerdictCountsErrorsBeyondTheRangeOfTheParameters) {
  io::write_whole(folder_ / "validate/summary.csv",
                  "body,kind,range,median\nall,displacement,inside,0.1\nall,displacement,outside,0.4\nall,volume,inside,0.05\n");
  io::write_whole(folder_ / "validate/signs.csv", "body,observable,count,wrong\nrobot,extent_x_m,5,0\n");
  expect_has(verdict(),
             "Do not trust the surrogate's shape of this body: 10 % off in the median; 40 % outside what the fit covers. See");
  EXPECT_EQ(found("validate"),
            "shape of this body: 10 % off in displacements, 5 % in chamber volume (medians); 40 % outside what the fit covers");
}

}  // namespace
}  // namespace menger::evolution
