#include "voxel/simulate/simulation_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"
#include "voxel/picture/vtk_output.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;

class SimulationRun : public testing::Test {
 protected:
  SimulationRun() {
    scene_.design = {.name = "bar", .body = meshes::Polycube::from_digits(3, 1, 1, "112"), .cell_edge_m = 0.01};
    scene_.duration_s = 0.02;
    scene_.record_interval_s = 0.005;
    scene_.output.pictures = false;
  }

  Scene scene_;
  const tests::TestFolder scratch_;
  const fs::path folder_ = scratch_ / "new";  ///< not there before a test writes
};

TEST_F(SimulationRun, RecordsTheStartEveryIntervalAndTheEnd) {
  scene_.duration_s = 0.018;  // no multiple of the interval
  const SceneResult result = run_scene(scene_, folder_);
  ASSERT_EQ(result.status, io::RunStatus::completed) << result.reason;
  const std::vector<double> times{0.0, 0.005, 0.010, 0.015, 0.018};
  ASSERT_EQ(result.trajectory.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_GE(result.trajectory[i].time_s, times[i]);
    EXPECT_LT(result.trajectory[i].time_s, times[i] + result.time_step_s);
  }
}

TEST_F(SimulationRun, AnIntervalBelowTheTimeStepRecordsEveryStepOnce) {
  scene_.duration_s = 0.001;
  scene_.record_interval_s = 1e-5;
  scene_.output.frames = false;
  const SceneResult result = run_scene(scene_, folder_);
  ASSERT_LT(scene_.record_interval_s, result.time_step_s);
  EXPECT_EQ(result.trajectory.size(), result.steps + 1);
}

TEST_F(SimulationRun, EveryNthRecordIsAFrame) {
  scene_.output.records_per_frame = 2;
  const SceneResult result = run_scene(scene_, folder_);
  const auto frames = read_collection(folder_ / "frames.pvd");
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[1].time_s, result.trajectory[2].time_s);
  EXPECT_EQ(frames[2].time_s, result.trajectory[4].time_s);
}

TEST_F(SimulationRun, DisplacementIsThatOfTheTrajectory) {
  const SceneResult result = run_scene(scene_, folder_);
  ASSERT_TRUE(result.displacement_m.has_value());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(result.displacement_m->at(axis),
              result.trajectory.back().centre_of_mass_m[axis] - result.trajectory.front().centre_of_mass_m[axis]);
  }
  ASSERT_EQ(result.recorded_frames.size(), 2U);
  EXPECT_EQ(result.recorded_frames[1].time_s, result.time_s);
}

TEST_F(SimulationRun, ResultIsTheSameOnASecondRun) {
  static_cast<void>(run_scene(scene_, folder_ / "a"));
  static_cast<void>(run_scene(scene_, folder_ / "b"));
  for (const char* file : {"result.toml", "trajectory.csv", "frames.pvd", "frames/frame_0004.vtu"}) {
    EXPECT_EQ(io::read_whole(folder_ / "a" / file), io::read_whole(folder_ / "b" / file)) << file;
  }
}

TEST_F(SimulationRun, LeavesNothingOfAnEarlierRunThatItDoesNotWrite) {
  static_cast<void>(run_scene(scene_, folder_));
  for (const char* name : {"robot.png", "trajectory.png", "manifest.json"}) io::write_whole(folder_ / name, "of an earlier run");
  const std::vector<std::string> earlier{"result.toml",    "manifest.json", "trajectory.csv",        "robot.png",
                                         "trajectory.png", "frames.pvd",    "frames/frame_0000.vtu", "frames/frame_0004.vtu"};
  for (const std::string& name : earlier) ASSERT_TRUE(fs::exists(folder_ / name)) << name;

  // What a run leaves that is killed at its first step is what is there then.
  scene_.output.frames = false;
  RunOptions options;
  bool is_first = true;
  options.progress = [&](const RunProgress&) {
    if (!std::exchange(is_first, false)) return;
    for (const std::string& name : earlier) EXPECT_FALSE(fs::exists(folder_ / name)) << name;
  };
  static_cast<void>(run_scene(scene_, folder_, options));
  EXPECT_FALSE(is_first);
  EXPECT_TRUE(fs::exists(folder_ / "result.toml"));
  EXPECT_TRUE(fs::exists(folder_ / "trajectory.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "frames.pvd"));
  EXPECT_FALSE(fs::exists(folder_ / "frames/frame_0000.vtu"));
}

TEST_F(SimulationRun, ABodyInPiecesIsNoted) {
  scene_.design.body = meshes::Polycube::from_digits(3, 1, 1, "102");
  const SceneResult pieces = run_scene(scene_, folder_);
  EXPECT_EQ(pieces.parts, 2U);
  ASSERT_EQ(pieces.notes.size(), 1U);
  EXPECT_NE(pieces.notes[0].find("2 pieces"), std::string::npos) << pieces.notes[0];
  scene_.design.body = meshes::Polycube::from_digits(3, 1, 1, "112");
  EXPECT_TRUE(run_scene(scene_, folder_).notes.empty());
}

TEST_F(SimulationRun, AStopEndsItWithoutADisplacement) {
  std::atomic<bool> stop = false;
  RunOptions options;
  options.stop = &stop;
  options.progress = [&](const RunProgress& now) { stop = now.time_s >= 0.01; };
  const SceneResult result = run_scene(scene_, folder_, options);
  EXPECT_EQ(result.status, io::RunStatus::stopped);
  EXPECT_FALSE(result.displacement_m.has_value());
  EXPECT_EQ(result.trajectory.size(), 3U);
  EXPECT_EQ(io::read_toml(folder_ / "result.toml").text("status"), "stopped");
}

TEST_F(SimulationRun, ProgressGrowsToTheDuration) {
  std::vector<double> times;
  RunOptions options;
  options.progress = [&](const RunProgress& now) {
    times.push_back(now.time_s);
    EXPECT_EQ(now.duration_s, 0.02);
    EXPECT_GE(now.remaining_s, 0.0);
  };
  static_cast<void>(run_scene(scene_, folder_, options));
  EXPECT_GE(times.size(), 4U);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_GE(times.back(), 0.02);
}

TEST_F(SimulationRun, ProgressIsReportedBetweenRecordsToo) {
  scene_.record_interval_s = scene_.duration_s;
  std::vector<double> times;
  RunOptions options;
  options.progress = [&](const RunProgress& now) { times.push_back(now.time_s); };
  const SceneResult result = run_scene(scene_, folder_, options);
  EXPECT_EQ(result.trajectory.size(), 2U);
  ASSERT_GE(times.size(), 2U);
  EXPECT_GT(times.front(), 0.0);
  EXPECT_LT(times.front(), scene_.duration_s);
}

TEST_F(SimulationRun, RecordsAreThoseOfASimulationInOneGo) {
  const SceneResult result = run_scene(scene_, folder_);
  Simulation simulation(scene_.design.body, scene_.design.cell_edge_m, scene_.physics);
  ASSERT_EQ(simulation.advance_to(scene_.duration_s), io::RunStatus::completed);
  EXPECT_EQ(result.steps, simulation.steps());
  EXPECT_EQ(result.trajectory.back().time_s, simulation.time_s());
  EXPECT_EQ(result.trajectory.back().centre_of_mass_m, simulation.centre_of_mass_m());
}

TEST_F(SimulationRun, TheLastFrameIsOfTheEndWhateverIsWritten) {
  for (const bool frames : {true, false}) {
    scene_.output.frames = frames;
    scene_.output.records_per_frame = 3;
    scene_.record_interval_s = 1e-5;  // below the time step: the end is often recorded before it is asked for
    scene_.duration_s = 0.001;
    const SceneResult result = run_scene(scene_, folder_);
    ASSERT_EQ(result.recorded_frames.size(), 2U);
    EXPECT_EQ(result.recorded_frames.front().time_s, 0.0);
    EXPECT_EQ(result.recorded_frames.back().time_s, result.time_s);
  }
}

TEST(ResultText, ADivergenceHasAValueAndALimitExactlyIfItIsFinite) {
  SceneResult result;
  result.divergence = Divergence{.voxel = 7, .cell = {}, .quantity = "speed", .value = 1.5, .limit = 1.25, .time_s = 0.5};
  const io::TomlTable finite = io::parse_toml(result_text(result), "result.toml").table("divergence");
  EXPECT_EQ(finite.number("value"), 1.5);
  EXPECT_EQ(finite.number("limit"), 1.25);
  result.divergence->quantity = "not finite";
  result.divergence->value.reset();
  const io::TomlTable infinite = io::parse_toml(result_text(result), "result.toml").table("divergence");
  EXPECT_EQ(infinite.text("quantity"), "not finite");
  EXPECT_FALSE(infinite.has("value"));
  EXPECT_FALSE(infinite.has("limit"));
}

TEST_F(SimulationRun, AnEngineThatRefusesTheSceneIsBadInput) {
  scene_.energy_ledger = true;
  scene_.physics.integration = {.damping = DampingMode::velocity, .number = NumberType::float32};
  RunOptions options;
  options.scene_file = "walk/scene.toml";
  try {
    static_cast<void>(run_scene(scene_, folder_, options));
    ADD_FAILURE() << "accepted";
  } catch (const io::InputError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("walk/scene.toml: cannot be simulated: ", 0), 0U) << error.what();
  }
}

}  // namespace
}  // namespace menger::voxel
