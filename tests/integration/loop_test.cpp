// `menger init` and `menger loop` with the programs that they start, on a robot of two cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "evolution/loop/loop_state.h"
#include "io/process/file_lock.h"
#include "io/text/csv_table.h"
#include "io/text/whole_file.h"
#include "tests/support/copied_program.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::Outcome;

constexpr const char* robot_text = R"([robot]
name = "cell"
layers = [["11"]]
cell_edge_m = 0.01
silicone = "dragon_skin_10"
[drive]
pressure_Pa = [0, 3000]
frequency_Hz = 10
[walk]
duration_s = 0.2
fidelity = "draft"
)";

class LoopProgram : public testing::Test {
 protected:
  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const {
    return test_support::ProgramRun(folder_, fs::path(MENGER_PROGRAM_DIR) / "menger", std::move(arguments)).wait();
  }

  [[nodiscard]] bool is_there(const std::string& file) const { return fs::is_regular_file(folder_ / file); }

  tests::TestFolder folder_;
};

void expect_has(const std::string& text, const std::string& part) { EXPECT_NE(text.find(part), std::string::npos) << text; }

TEST_F(LoopProgram, ComputesWhatARobotAsksForOnce) {
  io::write_whole(folder_ / "robot.toml", robot_text);
  const Outcome first = run({"loop", "robot.toml"});
  EXPECT_EQ(first.code, 0) << first.out << first.err;
  EXPECT_EQ(first.err, "");
  expect_has(first.out, "cell: 2 cells of 10 mm with walls of 2 mm, Dragon Skin 10, one chamber, 0 to 3 kPa at 10 Hz");
  expect_has(first.out, "parameters that come with menger");
  expect_has(first.out, "expected error for ");
  expect_has(first.out, " cm3 of silicone around ");
  expect_has(first.out, "at 3 kPa it holds ");
  expect_has(first.out, "it balloons at ");
  expect_has(first.out, "shape of this body: ");
  expect_has(first.out, "it moves ");
  expect_has(first.out, "What came out:\n- It bears its pressure of ");
  for (const char* file :
       {"mesh/mesh.vtu", "inflate/manifest.json", "limit/pv_curve.png", "validate/worst.png", "simulate/frames.pvd",
        "locomote/frames.pvd", "locomote_finer/locomotion.toml", "report.html", "manifest.json", "loop.json", "logs/limit.txt"})
    EXPECT_TRUE(is_there(std::string("results/") + file)) << file;

  const std::string walk = io::read_whole(folder_ / "results/locomote/manifest.json");
  const Outcome second = run({"loop", "robot.toml"});
  EXPECT_EQ(second.code, 0) << second.out << second.err;
  expect_has(second.out, "7 of 8  locomote_finer  as before: it moves ");
  expect_has(second.out, "8 of 8  report          as before");
  EXPECT_EQ(io::read_whole(folder_ / "results/locomote/manifest.json"), walk);
}

TEST_F(LoopProgram, RobotsAreStudiesOfTheOtherCommandsToo) {
  io::write_whole(folder_ / "mine/robot.toml", robot_text);
  for (const char* command : {"mesh", "inflate", "simulate", "locomote"}) {
    const Outcome outcome = run({command, "mine/robot.toml"});
    EXPECT_EQ(outcome.code, 0) << command << outcome.out << outcome.err;
    expect_has(outcome.out, std::string("mine/results/") + command);
  }
  const Outcome folder = run({"mesh", "mine"});
  EXPECT_EQ(folder.code, 0) << folder.err;
  expect_has(folder.out, "mine/results/mesh");
  const Outcome none = run({"calibrate", "mine/robot.toml"});
  EXPECT_EQ(none.code, 2);
  expect_has(none.err, "menger comes with voxels for these cells; to fit them anew, first menger loop mine/robot.toml --fit");
}

TEST_F(LoopProgram, GoesOnAfterCtrlC) {
  io::write_whole(folder_ / "robot.toml", robot_text);
  const fs::path program = fs::path(MENGER_PROGRAM_DIR) / "menger-loop";
  const test_support::ProgramRun loop(folder_, program, {"robot.toml", "--until", "limit"});
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!is_there("results/studies/inflate.toml") && loop.name() != "" && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  loop.send(SIGINT);
  const Outcome stopped = loop.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.out << stopped.err;
  const auto status = [&](const std::string& stage) {
    const evolution::LoopState state(folder_ / "results/loop.json");
    return state.find(stage) == nullptr ? evolution::StageStatus::left_out : state.find(stage)->status;
  };
  EXPECT_EQ(status("mesh"), evolution::StageStatus::done);
  EXPECT_EQ(status("inflate"), evolution::StageStatus::interrupted);
  const Outcome outcome = run({"loop", "robot.toml", "--until", "limit"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  expect_has(outcome.out, "1 of 8  mesh            as before");
  EXPECT_EQ(status("inflate"), evolution::StageStatus::done);
  EXPECT_EQ(status("limit"), evolution::StageStatus::done);
}

TEST_F(LoopProgram, WaitsAfterCtrlCForAProgramThatWritesWhatItHas) {
  io::write_whole(folder_ / "robot.toml", robot_text);
  test_support::copy_program(MENGER_PROGRAM_DIR "/menger-loop", folder_, "menger-loop");
  for (const char* name : {"mesh", "inflate", "validate", "load-cases", "simulate", "locomote"}) {
    const fs::path stand_in = folder_ / ("bin/menger-" + std::string(name));
    // Longer than a program is given that does not come to a stopping point.
    io::write_whole(
        stand_in,
        "#!/bin/bash\ntrap 'sleep 4; echo all > saved; exit 130' INT\necho > begun\nfor ((n = 0; n < 600; n++)); do sleep "
        "0.1; done\n");
    fs::permissions(stand_in, fs::perms::owner_all);
  }
  const test_support::ProgramRun loop(folder_, folder_ / "bin/menger-loop", {"robot.toml"});
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!is_there("results/begun") && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  loop.send(SIGINT);
  const Outcome stopped = loop.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.out << stopped.err;
  EXPECT_TRUE(is_there("results/saved"));
  expect_has(stopped.out, "Finished stages are kept");
}

TEST_F(LoopProgram, InitWritesARobotAndNeverOverOne) {
  const Outcome list = run({"init", "--list"});
  EXPECT_EQ(list.code, 0);
  for (const char* start : {"table", "quadruped", "crawler", "finger", "menger", "evolve"})
    expect_has(list.out, std::string(start) + " ");
  const Outcome made = run({"init", "mine", "--from", "crawler"});
  EXPECT_EQ(made.code, 0) << made.err;
  expect_has(made.out, "menger loop mine/robot.toml");
  const std::string text = io::read_whole(folder_ / "mine/robot.toml");
  expect_has(text, "name = \"mine\"");
  const Outcome again = run({"init", "mine"});
  EXPECT_EQ(again.code, 2);
  expect_has(again.err, "mine/robot.toml: is there already");
  EXPECT_EQ(io::read_whole(folder_ / "mine/robot.toml"), text);
  expect_has(run({"init", "finger"}).out, "wrote finger/robot.toml from finger: finger: 14 cells");
  expect_has(run({"init", "quadruped", "--from", "menger"}).out, "from menger: quadruped: 20 cells");
  expect_has(run({"init", "unnamed"}).out, "from crawler: unnamed: 12 cells");
  expect_has(run({"init", "my robot"}).out, "menger loop 'my robot/robot.toml' --until limit");
  const Outcome found = run({"init", "found", "--from", "evolve"});
  expect_has(found.out, "menger loop found/robot.toml                 (a quarter of an hour: the search");
  EXPECT_EQ(found.out.find("seconds"), std::string::npos) << found.out;
  EXPECT_EQ(run({"init"}).code, 2);
  EXPECT_EQ(run({"init", "."}).code, 0);
  expect_has(io::read_whole(folder_ / "robot.toml"), "name = \"" + fs::path(folder_).filename().string() + "\"");
  EXPECT_EQ(run({"init", "other", "--from", "cralwer"}).code, 2);
  EXPECT_EQ(run({"loop", "mine/robot.toml", "--write-studies"}).code, 0);
  EXPECT_TRUE(is_there("mine/results/studies/calibrate.toml"));
  EXPECT_FALSE(is_there("mine/results/loop.json"));
  const io::FileLock of_a_running_loop(folder_ / "mine/results/loop");
  const Outcome beside = run({"loop", "mine/robot.toml", "--write-studies"});
  EXPECT_EQ(beside.code, 2);
  expect_has(beside.err, "mine/results/loop");
}

/// How far the centre of mass goes along an axis in each of the last four seconds of a walk of 5 s, m.
std::vector<double> last_seconds_m(const fs::path& trajectory, const std::string& axis) {
  const io::CsvContents table = io::read_csv(trajectory);
  const std::vector<double> times_s = table.numbers("time_s");
  const std::vector<double> places_m = table.numbers("centre_of_mass_" + axis + "_m");
  const auto place_at = [&](double time_s) {
    const auto after = std::ranges::lower_bound(times_s, time_s - 1e-3);
    return places_m.at(static_cast<std::size_t>(after - times_s.begin()));
  };
  std::vector<double> steps_m;
  for (int second = 1; second < 5; ++second) steps_m.push_back(place_at(second + 1) - place_at(second));
  return steps_m;
}

// What the demo ends with. It goes along y: 3.6 mm in every second as voxels, and 2.8 to 3.0 mm on finite elements.
TEST_F(LoopProgram, TheTrotterWalksSteadilyAndTheSameWayInBothModels) {
  ASSERT_EQ(run({"init", "trotter"}).code, 0);
  ASSERT_EQ(run({"simulate", "trotter/robot.toml", "-o", "voxels"}).code, 0);
  ASSERT_EQ(run({"locomote", "trotter/robot.toml", "-o", "elements"}).code, 0);
  for (const char* model : {"voxels", "elements"}) {
    const fs::path trajectory = folder_ / model / "trajectory.csv";
    // Places are those of the next record, at most 20 ms later. Across its way it goes 0.15 mm in a second at most.
    for (const double along_m : last_seconds_m(trajectory, "y")) EXPECT_NEAR(along_m, 3.2e-3, 0.8e-3) << model;
    for (const double across_m : last_seconds_m(trajectory, "x")) EXPECT_NEAR(across_m, 0.0, 0.5e-3) << model;
  }
}

TEST_F(LoopProgram, WrongRobotEndsWithFileKeyAndValue) {
  io::write_whole(folder_ / "robot.toml", std::string(robot_text) + "[ground]\nkinetic_friction = 2\n");
  const Outcome outcome = run({"loop", "robot.toml"});
  EXPECT_EQ(outcome.code, 2);
  expect_has(outcome.err, "robot.toml:");
  expect_has(outcome.err, "ground.kinetic_friction = 2: must be at most static_friction");
  EXPECT_FALSE(fs::exists(folder_ / "results"));
}

}  // namespace
}  // namespace menger
