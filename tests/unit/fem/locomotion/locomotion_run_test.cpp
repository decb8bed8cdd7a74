#include "fem/locomotion/locomotion_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "fem/locomotion/locomotion_checkpoint.h"
#include "fem/walk/walk.h"
#include "io/text/csv_table.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"
#include "tests/unit/fem/locomotion/locomotion_samples.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;
using namespace locomotion_samples;
using tests::message_of;

const std::string piston_drive =
    "[[pressure]]\nplenum = \"plenum 0\"\nsupply = \"piston\"\npiston = \"cam\"\nresistance_Pa_s_per_m3 = 1e8\nvolume_m3 = 1e-6\n"
    "[[piston]]\nname = \"cam\"\nbore_m = 0.006\ncylinder_length_m = 0.02\nstroke_m = 0.01\nfrequency_Hz = 20\n";

class LocomotionRun : public testing::Test {
 protected:
  LocomotionResult run(const std::string& study, const std::string& name, const LocomotionRunOptions& options = {}) const {
    return run_locomotion(sample_study(study), folder_ / name, options);
  }

  /// Files of two runs that must not differ.
  void expect_same_files(const std::string& a, const std::string& b) const {
    std::vector<fs::path> files{"trajectory.csv", "frames.pvd"};
    for (const auto& entry : fs::directory_iterator(folder_ / a / "frames")) files.push_back("frames" / entry.path().filename());
    EXPECT_GE(files.size(), 4U) << "two tables and two frames at least";
    for (const fs::path& file : files) EXPECT_EQ(io::read_whole(folder_ / a / file), io::read_whole(folder_ / b / file)) << file;
    EXPECT_EQ(without_seconds(a), without_seconds(b));
  }

  [[nodiscard]] std::string without_seconds(const std::string& name) const {
    const std::string text = io::read_whole(folder_ / name / "locomotion.toml");
    return text.substr(0, text.find("seconds = "));
  }

  const tests::TestFolder folder_;
};

// Nothing breaks the symmetry of a cube but rounding, which steps could let grow.
TEST_F(LocomotionRun, ASymmetricBodyStaysWhereItIs) {
  const LocomotionResult single = run(cube_study, "single");
  ASSERT_EQ(single.status, io::RunStatus::completed) << single.reason;
  EXPECT_LT(travel_of(single)->horizontal_displacement_m, 1e-10);
  const LocomotionResult result = run(cube_study + "[elements]\nprecision = \"double\"\n", "out");
  ASSERT_EQ(result.status, io::RunStatus::completed) << result.reason;
  EXPECT_LT(travel_of(result)->horizontal_displacement_m, 1e-12);
  EXPECT_EQ(result.records.size(), 11U);
  EXPECT_EQ(result.records.back().time_s, 0.1);
}

TEST_F(LocomotionRun, IsTheWalkOfItsInputInMemory) {
  const LocomotionStudy study = sample_study(hook_study);
  const LocomotionResult by_files = run_locomotion(study, folder_ / "out");
  ASSERT_EQ(by_files.status, io::RunStatus::completed) << by_files.reason;
  WalkInput input = study;
  input.supply.reset();  // follows from the drive
  const WalkResult in_memory = walk(input);
  EXPECT_EQ(in_memory.status, by_files.status);
  EXPECT_EQ(in_memory.steps, by_files.steps);
  ASSERT_EQ(in_memory.records.size(), by_files.records.size());
  for (std::size_t n = 0; n < in_memory.records.size(); ++n) {
    EXPECT_EQ(in_memory.records[n].centre_of_mass_m, by_files.records[n].centre_of_mass_m) << n;
    EXPECT_EQ(in_memory.records[n].chamber_volumes_m3, by_files.records[n].chamber_volumes_m3) << n;
    EXPECT_EQ(in_memory.records[n].energies.imbalance_J(), by_files.records[n].energies.imbalance_J()) << n;
  }
}

// Left to itself a body settles: the ground carries its weight (silicone's volume times density times g). 0.3 s are four times
// longer than the decay time that its slowest motion, the sway on the springs of the ground, leaves.
TEST_F(LocomotionRun, ABodyAtRestWeighsWhatItWeighs) {
  std::string study = cube + silicone + ground + "[drive]\nmode = \"none\"\npressure_Pa = [0, 1]\nfrequency_Hz = 1\n" +
                      "[time]\nduration_s = 0.3\nrecord_interval_s = 0.1\n" + no_pictures;
  const LocomotionResult result = run(study, "out");
  ASSERT_EQ(result.status, io::RunStatus::completed) << result.reason;
  const double weight_N = 1070.0 * (std::pow(0.02, 3) - std::pow(0.012, 3)) * 9.81;
  EXPECT_NEAR(result.records.back().ground_force_N, weight_N, 0.01 * weight_N);
  EXPECT_EQ(result.records.front().ground_force_N, 0.0);
}

// A ratchet: on a ground that is smooth along +x and rough against it a cube that breathes creeps along +x, and its mirror image
// along -x by as much. What rounding adds is far below: contact is chaotic only where something hits the ground.
TEST_F(LocomotionRun, GoesWhereTheGroundLetsIt) {
  const auto study = [](const std::string& forward) {
    return cube + silicone + ground + "[ground.directional]\nforward = " + forward + "\nbackward_factor = 4\n" + drive + time +
           no_pictures;
  };
  const LocomotionResult right = run(study("[1, 0]"), "right");
  const LocomotionResult left = run(study("[-1, 0]"), "left");
  const LocomotionResult away = run(study("[0, 2]"), "away");
  ASSERT_TRUE(travel_of(right) && travel_of(left) && travel_of(away));
  const double path_m = travel_of(right)->displacement_m[0];
  EXPECT_GT(path_m, 1e-6);
  EXPECT_NEAR(travel_of(left)->displacement_m[0], -path_m, 1e-3 * path_m);
  EXPECT_NEAR(travel_of(away)->displacement_m[1], path_m, 1e-3 * path_m);
  EXPECT_NEAR(travel_of(away)->direction_deg, 90.0, 0.1);
}

// What pressure puts in is what the records say of it: int p dV over them is the work of the run, but for the error of the
// trapezia, of second order in their spacing, and for the first millisecond, in which the walls ring.
TEST_F(LocomotionRun, RecordsPressureAndVolumeOfOneTime) {
  std::string study = cube_study;
  study.replace(study.find("record_interval_s = 0.01"), 24, "record_interval_s = 0.001");
  const LocomotionResult result = run(study, "out");
  ASSERT_EQ(result.status, io::RunStatus::completed) << result.reason;
  double largest_J = 0.0;
  for (const WalkRecord& record : result.records) largest_J = std::max(largest_J, record.energies.work.pressure_J);
  double work_J = 0.0;
  double worst_J = 0.0;
  for (std::size_t r = 1; r < result.records.size(); ++r) {
    const WalkRecord& before = result.records[r - 1];
    const WalkRecord& now = result.records[r];
    work_J += 0.5 * (before.plenum_pressures_Pa[0] + now.plenum_pressures_Pa[0]) *
              (now.chamber_volumes_m3[0] - before.chamber_volumes_m3[0]);
    worst_J = std::max(worst_J, std::abs(work_J - now.energies.work.pressure_J));
  }
  EXPECT_LT(worst_J, 2e-3 * largest_J) << worst_J / largest_J;
  EXPECT_GT(largest_J, 0.0);
}

TEST_F(LocomotionRun, GivesTheSameBytesForAnyNumberOfThreads) {
  run(hook_study, "one");
  run(hook_study + "[dynamics]\nthreads = 3\n", "three");
  expect_same_files("one", "three");
}

// Stopped after each of its records but the last, and taken up again each time; air that a piston pushes through a line has a
// state of its own.
TEST_F(LocomotionRun, GoesOnWhereItWasStoppedAsIfNothingHadHappened) {
  for (const std::string& driven : {drive, piston_drive}) {
    const std::string study = hook + silicone + ground + driven + short_time + no_pictures;
    const LocomotionResult whole = run(study, "whole", {.restart = true});
    EXPECT_NE(whole.records.back().plenum_pressures_Pa[0], 0.0);
    std::size_t stops = 0;
    for (LocomotionResult result; result.status == io::RunStatus::stopped; ++stops) {
      std::atomic<bool> stop = false;
      const LocomotionRunOptions options{.restart = stops == 0, .stop = &stop, .progress = [&](double) { stop = true; }};
      result = run(study, "parts", options);
      ASSERT_LT(stops, 20U);
      if (result.status == io::RunStatus::stopped) {
        EXPECT_NE(result.reason.find("interrupted"), std::string::npos);
        EXPECT_FALSE(travel_of(result));
        EXPECT_TRUE(fs::exists(folder_ / "parts/trajectory.csv"));
      }
    }
    EXPECT_EQ(stops, 10U) << "nine stops between ten records, and the end";
    expect_same_files("whole", "parts");
  }
}

// The file is whole and of the study, but what it holds may be anything: no number of it is taken without a look at the body.
TEST_F(LocomotionRun, RefusesACheckpointThatDoesNotFitTheBodyAndTouchesNothing) {
  const std::string text = hook + rubber + ground + piston_drive + short_time + no_pictures;
  ASSERT_EQ(run(text, "out").status, io::RunStatus::completed);
  const fs::path checkpoint = folder_ / "out/locomotion.checkpoint";
  const std::string trajectory = io::read_whole(folder_ / "out/trajectory.csv");
  const LocomotionStudy study = sample_study(text);
  const std::string identity = locomotion_identity(study, *explicit_walk_dynamics(study, nullptr));
  const WalkProgress whole = read_locomotion_checkpoint(checkpoint, identity).value();
  ASSERT_TRUE(std::get<ExplicitState>(whole.state).branches && std::get<ExplicitState>(whole.state).pneumatics);
  const auto expect_refused = [&](const std::string& reason, const auto& change) {
    WalkProgress changed = whole;
    change(changed, std::get<ExplicitState>(changed.state));
    write_locomotion_checkpoint(checkpoint, identity, changed);
    const std::string message = message_of([&] { run(text, "out"); });
    EXPECT_NE(message.find("locomotion.checkpoint: does not fit the walk: " + reason), std::string::npos) << message;
    EXPECT_NE(message.find("; give --restart"), std::string::npos) << message;
    EXPECT_EQ(io::read_whole(folder_ / "out/trajectory.csv"), trajectory) << reason;
    EXPECT_TRUE(fs::exists(folder_ / "out/locomotion.toml")) << reason;
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  expect_refused("displacements_m has ", [](WalkProgress&, ExplicitState& s) { s.displacements_m.resize(12); });
  expect_refused("velocities_m_per_s has ", [](WalkProgress&, ExplicitState& s) { s.velocities_m_per_s.push_back(0.0); });
  expect_refused("velocities_m_per_s holds a number that is not finite",
                 [&](WalkProgress&, ExplicitState& s) { s.velocities_m_per_s.back() = none; });
  expect_refused("time_s holds", [&](WalkProgress&, ExplicitState& s) { s.stable_step_s = none; });
  expect_refused("the length of its steps", [](WalkProgress&, ExplicitState& s) { s.steps_to_bound = 0; });
  expect_refused("work holds", [&](WalkProgress&, ExplicitState& s) { s.work.friction_J = none; });
  expect_refused("energy holds", [&](WalkProgress&, ExplicitState& s) { s.at_start_J = none; });
  expect_refused("plenum_air_m3 has ", [](WalkProgress&, ExplicitState& s) { s.pneumatics->plenum_air_m3.clear(); });
  constexpr std::uint32_t nowhere = 4'000'000'000;
  for (const std::vector<ContactMemory>& memories : std::vector<std::vector<ContactMemory>>{
           {{.node = nowhere}}, {{.face = nowhere}}, {{.depth_m = none}}, {{.node = 1}, {.node = 1}}}) {
    expect_refused("contact is not that of the body's surface", [&](WalkProgress&, ExplicitState& s) { s.contact = memories; });
  }
  expect_refused("branches has ", [](WalkProgress&, ExplicitState& s) {
    std::visit([](auto& numbers) { numbers.pop_back(); }, s.branches->numbers);
  });
  expect_refused("pressures_Pa has ", [](WalkProgress&, ExplicitState& s) { s.pressures_Pa.push_back(0.0); });
  expect_refused("element ", [](WalkProgress&, ExplicitState& s) { s.displacements_m[2] = 1.0; });
  expect_refused("it is a state of implicit dynamics", [](WalkProgress& p, ExplicitState&) { p.state = ImplicitState{}; });
  expect_refused("it has 0 records", [](WalkProgress& p, ExplicitState&) { p.records.clear(); });
  expect_refused("it has 11 records", [](WalkProgress& p, ExplicitState&) { p.outcome.reset(); });
  expect_refused("the times of its records", [](WalkProgress& p, ExplicitState&) { p.records[1].time_s = 0.0; });
  expect_refused("its records are of other chambers",
                 [](WalkProgress& p, ExplicitState&) { p.records[3].chamber_volumes_m3.clear(); });
  expect_refused("its wall time", [&](WalkProgress& p, ExplicitState&) { p.seconds = none; });
  write_locomotion_checkpoint(checkpoint, identity, whole);
  EXPECT_EQ(run(text, "out").status, io::RunStatus::completed);
}

// Stopped by the clock, in the middle of its only record after the start.
TEST_F(LocomotionRun, GoesOnFromTheMiddleOfARecord) {
  std::string study = hook_study;
  study.replace(study.find("record_interval_s = 0.004"), 25, "record_interval_s = 0.04");
  study.replace(study.find("records_per_frame = 4"), 21, "records_per_frame = 1");
  run(study, "whole");
  std::size_t stops_on_the_way = 0;
  LocomotionResult result;
  for (int part = 1; result.status == io::RunStatus::stopped; ++part) {
    ASSERT_LT(part, 100);
    std::atomic<bool> stop = false;
    const std::jthread clock([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(10 * part));  // more each time, so that it ends somewhere
      stop = true;
    });
    result = run(study, "parts", {.stop = &stop});
    if (result.status == io::RunStatus::stopped && result.time_s > 0.0) ++stops_on_the_way;
  }
  EXPECT_GT(stops_on_the_way, 0U);
  expect_same_files("whole", "parts");
}

TEST_F(LocomotionRun, DoesNotComputeAgainWhatHasEnded) {
  const LocomotionResult first = run(hook_study, "out");
  const std::string trajectory = io::read_whole(folder_ / "out/trajectory.csv");
  fs::remove(folder_ / "out/trajectory.csv");
  bool has_moved = false;
  const LocomotionResult second = run(hook_study, "out", {.progress = [&](double) { has_moved = true; }});
  EXPECT_FALSE(has_moved);
  EXPECT_EQ(second.status, io::RunStatus::completed);
  EXPECT_EQ(second.seconds, first.seconds);
  EXPECT_EQ(io::read_whole(folder_ / "out/trajectory.csv"), trajectory);
  EXPECT_TRUE(fs::exists(folder_ / "out/frames/frame_0003.vtu"));
  (void)run(hook_study, "out", {.restart = true, .progress = [&](double) { has_moved = true; }});
  EXPECT_TRUE(has_moved);
}

TEST_F(LocomotionRun, DoesNotTakeUpAnotherStudy) {
  std::string study = hook_study;
  run(study, "out");
  study.replace(study.find("4000"), 4, "4500");
  const std::string message = message_of([&] { run(study, "out"); });
  EXPECT_NE(message.find("locomotion.checkpoint: belongs to another study or another number of processes; "
                         "give --restart to start again from the beginning"),
            std::string::npos)
      << message;
  EXPECT_TRUE(fs::exists(folder_ / "out/trajectory.csv")) << "nothing is written over";
  EXPECT_EQ(run(study, "out", {.restart = true}).status, io::RunStatus::completed);
}

// 60 kPa is beyond any equilibrium of this cube of shear modulus 50 kPa: for a thin neo-Hookean sphere of its mean radius (8 mm)
// and wall (4 mm) the limit is near 2 * 0.6197 * mu h / r = 31 kPa, and a cube with flat walls has less. The chamber runs away.
TEST_F(LocomotionRun, EndsBeyondTheLimitPressureWithAStatus) {
  std::string study =
      cube + silicone + ground + "[drive]\nmode = \"hold\"\npressure_Pa = [0, 60000]\nfrequency_Hz = 20\n" + time + no_pictures;
  const LocomotionResult result = run(study, "out");
  EXPECT_TRUE(result.status == io::RunStatus::diverged || result.status == io::RunStatus::inverted_element)
      << io::to_string(result.status);
  EXPECT_NE(result.reason.find(" at "), std::string::npos) << result.reason;
  EXPECT_LT(result.time_s, 0.1);
  EXPECT_EQ(result.records.back().time_s, result.time_s) << "what was reached is recorded";
  EXPECT_FALSE(travel_of(result));
  const std::string said = "status = \"" + std::string(io::to_string(result.status)) + "\"";
  EXPECT_NE(io::read_whole(folder_ / "out/locomotion.toml").find(said), std::string::npos);
  const io::CsvContents csv = io::read_csv(folder_ / "out/trajectory.csv");
  for (std::size_t row = 0; row < csv.row_count(); ++row)
    for (const std::string& column : csv.columns()) EXPECT_TRUE(std::isfinite(csv.number(row, column))) << column;
}

// A roof falls on its floor under six times the weight that it has. Without contact it goes on into the floor: what comes of that
// is no travel, is told with its time, and stays so when the folder is looked at again. Contact holds it.
TEST_F(LocomotionRun, ABodyThatGoesThroughItselfHasNotCompleted) {
  const std::string study =
      "[design]\nname = \"roof\"\ncells = [3, 1, 3]\ndigits = \"111100111\"\ncell_edge_m = 0.01\n"
      "wall_thickness_m = 0.002\n" +
      silicone + ground + "[loads]\ngravity_m_per_s2 = 60\n[drive]\nmode = \"none\"\npressure_Pa = [0, 1]\nfrequency_Hz = 1\n" +
      "[time]\nduration_s = 0.05\nrecord_interval_s = 0.005\n" + no_pictures;
  const LocomotionResult held = run(study, "held");
  EXPECT_EQ(held.status, io::RunStatus::completed) << held.reason;
  for (int look = 1; look <= 2; ++look) {
    const LocomotionResult lost = run(study + "[dynamics]\nself_contact = false\n", "lost");
    EXPECT_EQ(lost.status, io::RunStatus::diverged);
    EXPECT_TRUE(lost.reason.starts_with("walls went through each other: ")) << lost.reason;
    EXPECT_TRUE(lost.reason.ends_with(" at " + io::number_text(lost.time_s) + " s")) << lost.reason;
    EXPECT_LT(lost.time_s, 0.05);
    EXPECT_EQ(lost.records.back().time_s, lost.time_s);
    EXPECT_FALSE(travel_of(lost));
    EXPECT_NE(io::read_whole(folder_ / "lost/locomotion.toml").find("status = \"diverged\""), std::string::npos);
  }
}

// The steps that failed end at a record here, which is not the fourth and has no frame until it is the end.
TEST_F(LocomotionRun, KeepsTheFramesOfARunThatFailed) {
  const std::string study =
      cube + silicone + ground + "[drive]\nmode = \"hold\"\npressure_Pa = [0, 60000]\nfrequency_Hz = 20\n" +
      "[time]\nduration_s = 0.1\nrecord_interval_s = 2e-5\n[output]\npictures = false\nrecords_per_frame = 1000\n";
  const LocomotionResult result = run(study, "out");
  ASSERT_NE(result.status, io::RunStatus::completed);
  const auto frames = [&] {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_ / "out/frames")) files.push_back(entry.path().filename());
    return files.size();
  };
  const std::size_t due = (result.records.size() - 1) / 1000 + 1;
  const std::size_t made = (result.records.size() - 1) % 1000 == 0 ? due : due + 1;
  EXPECT_EQ(frames(), made) << "the end has one";
  const std::string collection = io::read_whole(folder_ / "out/frames.pvd");
  run(study, "out");
  EXPECT_EQ(frames(), made);
  EXPECT_EQ(io::read_whole(folder_ / "out/frames.pvd"), collection);
}

TEST_F(LocomotionRun, RefusesAFrequencyThatTheStepCannotResolve) {
  std::string study = cube_study;
  study.replace(study.find("frequency_Hz = 20"), 17, "frequency_Hz = 2e4");
  const std::string message = message_of([&] { run(study, "out"); });
  EXPECT_NE(message.find("study.toml: plenum \"plenum 0\": a ramp of 5e-05 s"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(folder_ / "out")) << "nothing is written";
}

TEST_F(LocomotionRun, LeavesNoFileOfAnEarlierRun) {
  io::write_whole(folder_ / "out/robot.png", "old");
  io::write_whole(folder_ / "out/frames/frame_0009.vtu", "old");
  io::write_whole(folder_ / "out/mine.txt", "mine");
  run(hook_study, "out");
  EXPECT_FALSE(fs::exists(folder_ / "out/robot.png"));
  EXPECT_FALSE(fs::exists(folder_ / "out/frames/frame_0009.vtu"));
  EXPECT_TRUE(fs::exists(folder_ / "out/mine.txt"));
}

}  // namespace
}  // namespace menger::fem
