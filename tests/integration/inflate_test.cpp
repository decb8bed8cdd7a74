#include <gtest/gtest.h>
#include <sys/mount.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "io/text/csv_table.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "tests/support/paraview_files.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"
#include "tests/support/two_processes.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::Outcome;
using test_support::ProgramRun;

/// The program in a folder of its own, with studies of a hollow cube of 98 linear elements.
class InflateProgram : public testing::Test {
 protected:
  InflateProgram() { io::write_whole(folder_ / "cube_design.toml", "name = \"cube\"\ncell_edge_m = 0.02\nlayers = [[\"1\"]]\n"); }

  /// Writes a study. @param path content of the table [path] @param more further tables
  void write_study(const std::string& path, const std::string& more = "", int degree = 1) const {
    io::write_whole(folder_ / "study.toml",
                    "[design]\nfile = \"cube_design.toml\"\nwall_thickness_m = 0.004\n"
                    "[material]\nbulk_modulus_Pa = 2.5e6\nlaw = {name = \"neo_hookean\", shear_modulus_Pa = 5e4}\n"
                    "[elements]\ndegree = " +
                        std::to_string(degree) + "\n[path]\n" + path + "\n" + more);
  }

  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const {
    return ProgramRun(folder_, MENGER_PROGRAM_DIR "/menger-inflate", std::move(arguments)).wait();
  }

  /// Starts the program with two ranks.
  [[nodiscard]] ProgramRun start_parallel(std::vector<std::string> arguments) const {
    return test_support::start_two_processes(folder_, MENGER_PROGRAM_DIR "/menger-inflate", std::move(arguments));
  }

  [[nodiscard]] Outcome run_parallel(std::vector<std::string> arguments) const {
    return start_parallel(std::move(arguments)).wait();
  }

  [[nodiscard]] io::CsvContents curves(const std::string& output) const { return io::read_csv(folder_ / output / "curves.csv"); }

  /// Returns curves.csv without its last column, which is wall time.
  [[nodiscard]] std::string curves_without_seconds(const std::string& output) const {
    std::string text;
    std::istringstream lines(io::read_whole(folder_ / output / "curves.csv"));
    for (std::string line; std::getline(lines, line);) text += line.substr(0, line.rfind(',')) + "\n";
    return text;
  }

  [[nodiscard]] bool has(const std::string& name) const { return fs::exists(folder_ / name); }

  const tests::TestFolder folder_;
};

double last(const io::CsvContents& table, const std::string& column) { return table.number(table.row_count() - 1, column); }

TEST_F(InflateProgram, WritesCurvesFieldsPicturesResultAndManifest) {
  write_study("pressure_Pa = [0, 3000]", "[[output.points]]\nname = \"rim\"\nposition_m = [0.02, 0.0, 0.02]\n");
  const Outcome outcome = run({"study.toml", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvContents table = curves("out");
  EXPECT_EQ(last(table, "plenum_0_pressure_Pa"), 3000.0);
  EXPECT_NEAR(table.number(0, "plenum_0_volume_m3"), 1.728e-6, 1e-18);
  EXPECT_GT(last(table, "plenum_0_volume_m3"), 1.728e-6);
  EXPECT_GT(last(table, "top_centre_displacement_z_m"), 0.0);
  EXPECT_GT(last(table, "side_centre_displacement_x_m"), 0.0);
  EXPECT_GT(last(table, "rim_largest_stretch"), 1.0);
  EXPECT_EQ(table.number(0, "rim_displacement_x_m"), 0.0);
  EXPECT_EQ(io::read_toml(folder_ / "out/result.toml").text("status"), "completed");
  const std::string solver =
      "direct: " + std::to_string(io::read_toml(folder_ / "out/result.toml").integer("unknowns")) + " unknowns";
  EXPECT_EQ(io::read_toml(folder_ / "out/result.toml").text("linear_solver"), solver);
  EXPECT_NE(io::read_whole(folder_ / "out/manifest.json").find(solver), std::string::npos);
  for (const char* name : {"manifest.json", "fields.pvd", "path.checkpoint"})
    EXPECT_TRUE(has(std::string("out/") + name)) << name;
  test_support::expect_opens_in_paraview(folder_ / "out");
  if (outcome.out.find("no pictures") == std::string::npos) {
    for (const char* name : {"chamber.png", "pv_curve.png", "displacement.png"})
      EXPECT_EQ(io::read_whole(folder_ / "out" / name).substr(1, 3), "PNG") << name;
  }
}

TEST_F(InflateProgram, SaysOnceHowFarOneElementThroughTheWallIsOff) {
  write_study("pressure_Pa = [0, 1000]", "[output]\nfields = false\npictures = false\n");
  const Outcome outcome = run({"study.toml", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto first = outcome.out.find("design.elements_through_wall = 2");
  ASSERT_NE(first, std::string::npos) << outcome.out;
  EXPECT_LT(first, outcome.out.find("completed")) << outcome.out;
  EXPECT_EQ(outcome.out.find("design.elements_through_wall = 2", first + 1), std::string::npos) << outcome.out;
}

TEST_F(InflateProgram, WorkOfThePressureIsTheEnergyStored) {
  write_study("pressure_Pa = [0, 3000]\nlargest_step = 0.02\nfirst_step = 0.02", "[output]\nfields = false\npictures = false\n");
  ASSERT_EQ(run({"study.toml", "-o", "out"}).code, 0);
  const io::CsvContents table = curves("out");
  const double energy_J = last(table, "strain_energy_J");
  // the work is a sum of trapezoids over 50 steps: its error is 1/50^2 times the curvature of p(V), which is below 1 here
  EXPECT_NEAR(last(table, "work_J"), energy_J, 4e-4 * energy_J);
}

TEST_F(InflateProgram, FieldsAgreeWithTheCurves) {
  write_study("pressure_Pa = [0, 3000]", "[output]\npictures = false\nfields_every = 100\n");
  ASSERT_EQ(run({"study.toml", "-o", "out"}).code, 0);
  const io::CsvContents table = curves("out");
  const auto steps = table.row_count() - 1;
  std::string number = std::to_string(steps);
  number.insert(0, 4 - number.size(), '0');
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "out/fields"), fs::directory_iterator()), 2)
      << "the first state and the last";
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder_ / "out/fields" / ("step_" + number + ".vtu")).c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  // a corner of the body is a node; with five elements along a side the middle of its top is not
  const vtkIdType node = grid.FindPoint(0.02, 0.02, 0.02);
  ASSERT_GE(node, 0);
  EXPECT_GT(grid.GetPointData()->GetArray("displacement_m")->GetComponent(node, 2), 0.0);
  double highest = 0.0;
  for (vtkIdType n = 0; n < grid.GetNumberOfPoints(); ++n) {
    const double displacement_m = grid.GetPointData()->GetArray("displacement_m")->GetComponent(n, 2);
    if (std::abs(grid.GetPoint(n)[2] - displacement_m - 0.02) < 1e-12) highest = std::max(highest, displacement_m);
  }
  // with five elements along a side the middle of the top is between the four nodes that move most, all equally
  EXPECT_NEAR(last(table, "top_centre_displacement_z_m"), highest, 1e-6 * highest);
}

TEST_F(InflateProgram, EndedStudyIsShownAndNotComputedAgain) {
  write_study("pressure_Pa = [0, 3000]", "[output]\nfields_every = 2\n");
  ASSERT_EQ(run({"study.toml", "-o", "out"}).code, 0);
  const std::string before = io::read_whole(folder_ / "out/curves.csv");
  const std::string collection = io::read_whole(folder_ / "out/fields.pvd");
  const bool draws = has("out/chamber.png");
  const Outcome again = run({"study.toml", "-o", "out", "--no-pictures"});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.out.find("resumed"), std::string::npos) << again.out;
  EXPECT_EQ(io::read_whole(folder_ / "out/curves.csv"), before) << "wall times included";
  EXPECT_EQ(io::read_whole(folder_ / "out/fields.pvd"), collection);
  EXPECT_EQ(has("out/chamber.png"), draws) << "pictures of the path stay where none are wanted anew";
  EXPECT_EQ(has("out/pv_curve.png"), draws);
  EXPECT_EQ(has("out/displacement.png"), draws);
}

TEST_F(InflateProgram, InterruptedRunGoesOnToTheSameBytes) {
  write_study("pressure_Pa = [0, 3000, 0]\nlargest_step = 0.04\nfirst_step = 0.002", "[output]\npictures = false\n");
  ASSERT_EQ(run({"study.toml", "-o", "whole"}).code, 0);
  const ProgramRun program(folder_, MENGER_PROGRAM_DIR "/menger-inflate", {"study.toml", "-o", "parts"});
  const auto has_rows = [&] { return has("parts/curves.csv") && curves("parts").row_count() >= 3; };
  while (!has_rows()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.send(SIGINT);
  const Outcome stopped = program.wait();
  ASSERT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_EQ(io::read_toml(folder_ / "parts/result.toml").text("status"), "stopped");
  const std::size_t done = curves("parts").row_count();
  ASSERT_LT(done, curves("whole").row_count()) << "the run was over before it could be interrupted";
  const Outcome resumed = run({"study.toml", "-o", "parts"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.out.find(std::to_string(done) + " states resumed from an earlier run"), std::string::npos) << resumed.out;
  EXPECT_EQ(curves_without_seconds("parts"), curves_without_seconds("whole"));
  EXPECT_EQ(io::read_whole(folder_ / "parts/fields.pvd"), io::read_whole(folder_ / "whole/fields.pvd"));
}

// A thick cube whose first factorisation takes some seconds of processor time. The program is in it, or in the assembly before
// it, soon after its first point.
TEST_F(InflateProgram, LeavesALongFactorisationAndGoesOnToTheSameBytes) {
  io::write_whole(folder_ / "thick.toml",
                  "[design]\nfile = \"cube_design.toml\"\nwall_thickness_m = 0.008\nelements_through_wall = 11\n"
                  "[material]\nbulk_modulus_Pa = 2.5e6\nlaw = {name = \"neo_hookean\", shear_modulus_Pa = 5e4}\n"
                  "[elements]\ndegree = 1\n[path]\npressure_Pa = [0, 300]\nfirst_step = 0.5\n"
                  "[solver]\nlinear = \"direct\"\n[output]\npictures = false\n");
  ASSERT_EQ(run({"thick.toml", "-o", "whole"}).code, 0);
  const ProgramRun program(folder_, MENGER_PROGRAM_DIR "/menger-inflate", {"thick.toml", "-o", "parts"});
  while (!has("parts/path.checkpoint")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.wait_for_processor_seconds(program.processor_seconds() + 0.3);
  const auto start = std::chrono::steady_clock::now();
  program.send(SIGINT);
  const Outcome stopped = program.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  ASSERT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_EQ(stopped.err, "menger-inflate: stopped in the middle of a computation; finished parts are kept\n");
  EXPECT_FALSE(has("parts/result.toml")) << "no result of an earlier run or of part of this one";
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / "parts"))
    EXPECT_EQ(entry.path().string().find("partial"), std::string::npos) << entry.path();
  const Outcome resumed = run({"thick.toml", "-o", "parts"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.out.find("1 states resumed from an earlier run"), std::string::npos) << resumed.out;
  EXPECT_EQ(curves_without_seconds("parts"), curves_without_seconds("whole"));
  EXPECT_EQ(io::read_whole(folder_ / "parts/fields.pvd"), io::read_whole(folder_ / "whole/fields.pvd"));
}

TEST_F(InflateProgram, RefusesTheCheckpointOfAnotherStudyUnlessToldToBeginAnew) {
  write_study("pressure_Pa = [0, 1000]", "[output]\nfields = false\npictures = false\n");
  ASSERT_EQ(run({"study.toml", "-o", "out"}).code, 0);
  const std::string before = io::read_whole(folder_ / "out/curves.csv");
  write_study("pressure_Pa = [0, 1500]", "[output]\nfields = false\npictures = false\n");
  const Outcome refused = run({"study.toml", "-o", "out"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("out/path.checkpoint"), std::string::npos) << refused.err;
  EXPECT_EQ(io::read_whole(folder_ / "out/curves.csv"), before) << "nothing is written over";
  EXPECT_EQ(run({"study.toml", "-o", "out", "--restart"}).code, 0);
  EXPECT_EQ(last(curves("out"), "plenum_0_pressure_Pa"), 1500.0);
}

TEST_F(InflateProgram, TwoRanksGiveTheSameAnswer) {
  write_study("pressure_Pa = [0, 3000]", "[output]\npictures = false\n", 2);
  ASSERT_EQ(run({"study.toml", "-o", "one"}).code, 0);
  const Outcome parallel = run_parallel({"study.toml", "-o", "two"});
  ASSERT_EQ(parallel.code, 0) << parallel.err;
  EXPECT_EQ(parallel.out.find("completed"), parallel.out.rfind("completed")) << "one rank speaks";
  const io::CsvContents one = curves("one");
  const io::CsvContents two = curves("two");
  ASSERT_EQ(one.row_count(), two.row_count());
  for (const char* column : {"plenum_0_volume_m3", "top_centre_displacement_z_m", "side_centre_displacement_x_m",
                             "top_centre_largest_stretch", "strain_energy_J"}) {
    // the equilibria agree to the force tolerance of 1e-7; Newton's last step is much more exact
    EXPECT_NEAR(last(two, column), last(one, column), 1e-7 * std::abs(last(one, column))) << column;
  }
  std::string number = std::to_string(two.row_count() - 1);
  number.insert(0, 4 - number.size(), '0');
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName((folder_ / "two/fields" / ("step_" + number + ".pvtu")).c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 98);
  ASSERT_NE(reader->GetOutput()->GetPointData()->GetArray("cauchy_stress_Pa"), nullptr);
  test_support::expect_opens_in_paraview(folder_ / "two");
}

/// A study of thin walls: a cube of 20 mm with walls of 4 mm. @param more further tables
std::string thin_wall_study(const std::string& more = "") {
  return "[elements]\nkind = \"thin_wall\"\nfidelity = \"draft\"\n"
         "[design]\nfile = \"cube_design.toml\"\nwall_thickness_m = 0.004\n"
         "[material]\nbulk_modulus_Pa = 2.5e6\nlaw = {name = \"neo_hookean\", shear_modulus_Pa = 5e4}\n"
         "[path]\npressure_Pa = [0, 3000]\n" +
         more;
}

TEST_F(InflateProgram, TwoRanksGiveTheSameAnswerWithThinWalls) {
  io::write_whole(folder_ / "study.toml", thin_wall_study("[output]\npictures = false\n"));
  ASSERT_EQ(run({"study.toml", "-o", "one"}).code, 0);
  const Outcome parallel = run_parallel({"study.toml", "-o", "two"});
  ASSERT_EQ(parallel.code, 0) << parallel.err;
  const io::CsvContents one = curves("one");
  const io::CsvContents two = curves("two");
  ASSERT_EQ(one.row_count(), two.row_count());
  EXPECT_GT(last(one, "plenum_0_volume_m3"), 1.02 * one.number(0, "plenum_0_volume_m3"));
  for (const char* column : {"plenum_0_volume_m3", "top_centre_displacement_z_m", "side_centre_displacement_x_m",
                             "top_centre_largest_stretch", "strain_energy_J", "work_J"})
    EXPECT_NEAR(last(two, column), last(one, column), 1e-7 * std::abs(last(one, column))) << column;
}

TEST_F(InflateProgram, SaysThatThinWallsAreNotRefined) {
  io::write_whole(folder_ / "study.toml", thin_wall_study());
  const Outcome outcome = run({"study.toml", "-o", "out", "--refine", "1"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("elements.kind"), std::string::npos) << outcome.err;
  EXPECT_FALSE(has("out"));
}

// mpirun needs some seconds to pass Ctrl-C on, and ends with its own exit code. A path of ten thousand steps is long enough.
TEST_F(InflateProgram, StopsOnTwoRanks) {
  write_study("pressure_Pa = [0, 3000, 0]\nlargest_step = 0.0002\nfirst_step = 0.0002",
              "[output]\nfields = false\npictures = false\n");
  const ProgramRun program = start_parallel({"study.toml", "-o", "out"});
  const auto has_rows = [&] { return has("out/curves.csv") && curves("out").row_count() >= 3; };
  for (int n = 0; n < 60000 && !has_rows(); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.send(SIGINT);
  EXPECT_NE(program.wait().code, 0);
  ASSERT_TRUE(has("out/result.toml"));
  EXPECT_EQ(io::read_toml(folder_ / "out/result.toml").text("status"), "stopped");
  EXPECT_LT(curves("out").row_count(), 10001U);
}

TEST_F(InflateProgram, BadInputEndsAllRanks) {
  write_study("pressure_Pa = [0, 3000]\nfirst_stepp = 1");
  const Outcome outcome = run_parallel({"study.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("path.first_stepp"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("path.first_stepp"), outcome.err.rfind("path.first_stepp")) << "one rank speaks";
  EXPECT_FALSE(has("out"));
}

TEST_F(InflateProgram, RefinementComparesMeshes) {
  write_study("pressure_Pa = [0, 1000]", "[output]\nfields = false\n");
  const Outcome outcome = run({"study.toml", "-o", "out", "--refine", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvContents table = io::read_csv(folder_ / "out/convergence.csv");
  ASSERT_GE(table.row_count(), 2U);
  EXPECT_EQ(table.number(0, "elements"), 98.0);
  EXPECT_EQ(table.number(1, "elements"), 784.0);
  EXPECT_NEAR(table.number(1, "element_size_m"), 0.002, 1e-12);
  EXPECT_NEAR(table.number(1, "change"), table.number(1, "value") - table.number(0, "value"), 1e-15);
  EXPECT_TRUE(has("out/refinement_1/curves.csv"));
  EXPECT_TRUE(has("out/convergence.png") || outcome.out.find("no pictures") != std::string::npos);
}

TEST_F(InflateProgram, WarnsOfLawsOutsideTheirRangeAndRefusesWithStrict) {
  const std::string head =
      "[design]\nfile = \"cube_design.toml\"\nwall_thickness_m = 0.004\n[elements]\ndegree = 1\n[output]\n"
      "fields = false\npictures = false\n[material]\nsilicone = \"dragon_skin_10\"\n[path]\n";
  io::write_whole(folder_ / "vacuum.toml", head + "pressure_Pa = [0, -200]\n");
  const Outcome warned = run({"vacuum.toml", "-o", "out"});
  EXPECT_EQ(warned.code, 0) << warned.err;
  EXPECT_NE(warned.out.find("fitted to stretch alone"), std::string::npos) << warned.out;
  const Outcome refused = run({"vacuum.toml", "-o", "out", "--strict"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("fitted to stretch alone"), std::string::npos) << refused.err;

  // the third neo-Hookean law of the record holds up to a stretch of 1.2
  std::string far_text = head + "volume_ratio = [1, 3]\n";
  far_text.replace(far_text.find("[path]"), 0, "law_name = \"neo_hookean\"\nlaw_variant = 3\n");
  io::write_whole(folder_ / "far.toml", far_text);
  const Outcome far = run({"far.toml", "-o", "far", "--strict"});
  EXPECT_EQ(far.code, 3) << far.err;
  const std::string reason = io::read_toml(folder_ / "far/result.toml").text("reason");
  EXPECT_NE(reason.find("centre\" reaches 1.2"), std::string::npos) << reason;
  EXPECT_NE(reason.find("largest_stretch = 1.2"), std::string::npos) << reason;

  // a path that has ended is treated in the same way, and stays as it is
  ASSERT_EQ(run({"far.toml", "-o", "ended"}).code, 0);
  EXPECT_EQ(run({"far.toml", "-o", "ended", "--strict"}).code, 3);
  EXPECT_EQ(io::read_toml(folder_ / "ended/result.toml").text("reason"), reason);
  EXPECT_EQ(run({"far.toml", "-o", "ended"}).code, 0);
}

TEST_F(InflateProgram, SymmetricBodyDoesNotTurnWithoutANodeInItsMiddle) {
  write_study(
      "pressure_Pa = [0, 3000]",
      "[[output.points]]\nname = \"left\"\nposition_m = [0.0, 0.0, 0.02]\n"
      "[[output.points]]\nname = \"right\"\nposition_m = [0.02, 0.0, 0.02]\n[output]\nfields = false\npictures = false\n");
  const Outcome outcome = run({"study.toml", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvContents table = curves("out");
  const double moved_m = std::abs(last(table, "left_displacement_z_m"));
  ASSERT_GT(moved_m, 0.0);
  // the sides are mirror images: they differ by the force tolerance of 1e-7, over a lever five times that of the supports
  EXPECT_NEAR(last(table, "left_displacement_y_m"), last(table, "right_displacement_y_m"), 1e-5 * moved_m);
}

TEST_F(InflateProgram, BadInputNamesFileKeyAndValueAndWritesNothing) {
  EXPECT_EQ(run({"none.toml"}).code, 2);
  EXPECT_EQ(run({"study.toml", "--refine", "9"}).code, 2);
  EXPECT_EQ(run({"study.toml", "--unknown"}).code, 2);
  write_study("pressure_Pa = [0, 3000]", "[supports]\nkind = \"hanging\"\n");
  const Outcome outcome = run({"study.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 2);
  for (const char* part : {"study.toml", "supports.kind", "hanging"})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  write_study("pressure_Pa = [0, 3000]", "[[output.points]]\nname = \"inside\"\nposition_m = [0.01, 0.01, 0.01]\n");
  const Outcome outside = run({"study.toml", "-o", "out"});
  EXPECT_EQ(outside.code, 2);
  EXPECT_NE(outside.err.find("inside"), std::string::npos) << outside.err;
  EXPECT_FALSE(has("out/curves.csv"));
}

TEST_F(InflateProgram, SaysWhenTheFolderCannotBeWritten) {
  write_study("pressure_Pa = [0, 3000]");
  io::write_whole(folder_ / "taken", "a file");
  const Outcome outcome = run({"study.toml", "-o", "taken"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("taken"), std::string::npos) << outcome.err;
}

TEST_F(InflateProgram, FullDiskEndsTheRunWithAMessageAndKeepsWhatWasThere) {
  const fs::path disk = folder_ / "disk";
  fs::create_directories(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0) GTEST_SKIP() << "no right to mount a small disk";
  write_study("pressure_Pa = [0, 3000]\nlargest_step = 0.05\nfirst_step = 0.05", "[output]\npictures = false\n", 2);
  const Outcome outcome = run({"study.toml", "-o", "disk"});
  const std::string curves_text = io::read_whole(disk / "curves.csv");
  umount(disk.c_str());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("cannot be written"), std::string::npos) << outcome.err;
  for (const char* noise : {"vtk", "ERROR:", "PETSC", "Warning"})
    EXPECT_EQ(outcome.err.find(noise), std::string::npos) << "the library says it, too: " << outcome.err;
  EXPECT_EQ(curves_text.back(), '\n') << "a table that was there is whole";
}

// While its libraries are loaded and started, nothing in the program can answer: the signal waits.
TEST_F(InflateProgram, InterruptedBeforeItsFirstLineLeavesAsAlways) {
  write_study("pressure_Pa = [0, 3000]");
  const ProgramRun program(folder_, MENGER_PROGRAM_DIR "/menger", {"inflate", "study.toml", "-o", "out"});
  while (program.name() != "menger-inflate") std::this_thread::sleep_for(std::chrono::milliseconds(1));
  program.send(SIGTERM);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 130) << "signal " << outcome.signal << ": " << outcome.err;
}

// Refused after meshing, which is all that the test takes time for.
TEST_F(InflateProgram, BodyThatDoesNotFitIntoMemoryIsRefusedWithTheKeysThatDecideIt) {
  write_study("pressure_Pa = [0, 3000]", "[supports]\nkind = \"ground_held\"\n", 2);
  std::string study = io::read_whole(folder_ / "study.toml");
  study.replace(study.find("[material]"), 0, "elements_through_wall = 8\n");
  study.replace(study.find("bulk_modulus_Pa"), 0, "density_kg_per_m3 = 1070\n");
  io::write_whole(folder_ / "study.toml", study);
  for (const char* command : {"menger-inflate", "menger-modes"}) {
    const std::string limited = std::string("ulimit -d 3000000; exec '" MENGER_PROGRAM_DIR "/") + command + "' study.toml -o out";
    const Outcome outcome = ProgramRun(folder_, "/bin/sh", {"-c", limited}).wait();
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    for (const char* words :
         {"study.toml", "unknowns of", "GB of memory", "elements.degree = 2", "design.elements_through_wall = 8"})
      EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_TRUE(!has("out") || fs::is_empty(folder_ / "out"));
  }
}

TEST_F(InflateProgram, HelpShowsAnExample) {
  const Outcome outcome = run({"--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("menger inflate fem/studies/cube.toml"), std::string::npos);
}

}  // namespace
}  // namespace menger
