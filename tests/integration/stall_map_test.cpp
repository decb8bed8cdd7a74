#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/text/csv_table.h"
#include "io/text/whole_file.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::Outcome;
using test_support::ProgramRun;

/// The program in a folder of its own, with a small map.
class StallMapProgram : public testing::Test {
 protected:
  StallMapProgram() {
    io::write_whole(folder_ / "curve.csv", "pressure_Pa,volume_m3\n0,5e-6\n1000,6e-6\n5000,9e-6\n");
    write_study("");
  }

  void write_study(const std::string& more) const {
    io::write_whole(folder_ / "study.toml",
                    "[plenum]\ncurve = 'curve.csv'\ncount = 9\n[piston]\nbore_m = 0.03\ncylinder_length_m = 0.2\n"
                    "[line]\nlength_m = 1\n[map]\nfrequencies_Hz = [1.2, 3]\n"
                    "resistances_Pa_s_per_m3 = {lowest = 1e6, highest = 1e9, count = 3}\n"
                    "strokes_m = {longest = 0.06, count = 4}\nisobars_Pa = [1000]\n" +
                        more);
  }

  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const {
    return ProgramRun(folder_, MENGER_PROGRAM_DIR "/menger-stall-map", std::move(arguments)).wait();
  }

  const tests::TestFolder folder_;
};

TEST_F(StallMapProgram, WritesTheMapAndItsIsobars) {
  const Outcome outcome = run({"study.toml", "-o", "out", "--no-pictures"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvContents map = io::read_csv(folder_ / "out/stall_map.csv");
  ASSERT_EQ(map.row_count(), 24U);
  for (std::size_t row = 0; row < map.row_count(); ++row)
    EXPECT_GE(map.number(row, "peak_pressure_Pa"), map.number(row, "lowest_pressure_Pa"));
  EXPECT_EQ(io::read_csv(folder_ / "out/isobars.csv").row_count(), 12U) << "two measures, two frequencies, three resistances";
  EXPECT_TRUE(fs::exists(folder_ / "out/manifest.json"));
  const std::string first = io::read_whole(folder_ / "out/stall_map.csv");
  ASSERT_EQ(run({"study.toml", "-o", "out", "--no-pictures"}).code, 0);
  EXPECT_EQ(io::read_whole(folder_ / "out/stall_map.csv"), first);
}

TEST_F(StallMapProgram, BadInputLeavesResultsAlone) {
  ASSERT_EQ(run({"study.toml", "-o", "out", "--no-pictures"}).code, 0);
  const std::string first = io::read_whole(folder_ / "out/stall_map.csv");
  write_study("colour = 'red'\n");
  const Outcome outcome = run({"study.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("colour"), std::string::npos) << outcome.err;
  EXPECT_EQ(io::read_whole(folder_ / "out/stall_map.csv"), first);
}

TEST_F(StallMapProgram, ARobotThatCannotWalkLeavesResultsAlone) {
  ASSERT_EQ(run({"study.toml", "-o", "out", "--no-pictures"}).code, 0);
  const std::string first = io::read_whole(folder_ / "out/stall_map.csv");
  io::write_whole(folder_ / "leg.toml", "name = 'leg'\ncell_edge_m = 0.5\nlayers = [['100','000','000'],['111','000','000']]\n");
  write_study("[travel]\ndesign = {file = 'leg.toml'}\nparameters = '" MENGER_PARAMETERS
              "'\nperiods = 2\nevery_resistance = 2\nevery_stroke = 4\n");
  const Outcome outcome = run({"study.toml", "-o", "out", "--no-pictures"});
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_EQ(io::read_whole(folder_ / "out/stall_map.csv"), first);
  EXPECT_TRUE(fs::exists(folder_ / "out/isobars.csv"));
}

TEST_F(StallMapProgram, RunsItsTemplate) {
  const Outcome outcome = run({"--template"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  io::write_whole(folder_ / "template.toml", outcome.out);
  const Outcome map = run({"template.toml", "-o", "out", "--no-pictures"});
  EXPECT_EQ(map.code, 0) << map.err;
  EXPECT_EQ(io::read_csv(folder_ / "out/stall_map.csv").row_count(), 50U);
  EXPECT_NE(run({"--keys"}).out.find("map.strokes_m.longest"), std::string::npos);
  EXPECT_NE(run({"--schema"}).out.find("\"longest\""), std::string::npos);
}

/// Returns the speed in body lengths per minute after the first period of 20 records, from the files of menger simulate.
double speed_of(const fs::path& result, double body_length_m) {
  const io::CsvContents path = io::read_csv(result / "trajectory.csv");
  const std::size_t last = path.row_count() - 1;
  const auto moved = [&](const char* column) { return path.number(last, column) - path.number(20, column); };
  return 60.0 * std::hypot(moved("centre_of_mass_x_m"), moved("centre_of_mass_y_m")) / (body_length_m * moved("time_s"));
}

TEST_F(StallMapProgram, RobotWalksAtPointsOfTheMap) {
  io::write_whole(folder_ / "leg.toml", "name = 'leg'\ncell_edge_m = 0.01\nlayers = [['100','000','000'],['111','000','000']]\n");
  write_study("[travel]\ndesign = {file = 'leg.toml'}\nparameters = '" MENGER_PARAMETERS
              "'\nperiods = 2\nevery_resistance = 2\nevery_stroke = 4\n");
  const Outcome outcome = run({"study.toml", "-o", "out", "--no-pictures"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvContents travel = io::read_csv(folder_ / "out/travel.csv");
  ASSERT_GE(travel.row_count(), 2U) << "two resistances, two frequencies, less what is beyond the curve";
  std::map<fs::path, fs::file_time_type> made;
  for (const auto& entry : fs::directory_iterator(folder_ / "out/travel"))
    made[entry.path()] = fs::last_write_time(entry.path() / "result/result.toml");
  EXPECT_EQ(made.size(), travel.row_count());
  for (std::size_t row = 0; row < travel.row_count(); ++row) {
    ASSERT_EQ(travel.text(row, "status"), "completed");
    const double speed = travel.number(row, "body_lengths_per_minute");
    EXPECT_TRUE(std::ranges::any_of(made, [&](const auto& run) {
      return std::abs(speed_of(run.first / "result", 0.03) - speed) <= 1e-9 * speed;
    })) << row;
  }
  // the runs are found, not made again
  ASSERT_EQ(run({"study.toml", "-o", "out", "--no-pictures"}).code, 0);
  for (const auto& [folder, time] : made) EXPECT_EQ(fs::last_write_time(folder / "result/result.toml"), time);
}

}  // namespace
}  // namespace menger
