#include "fem/locomotion/locomotion_sweep.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <string>

#include "io/process/run_folder.h"
#include "io/text/csv_table.h"
#include "io/text/manifest.h"
#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"
#include "tests/unit/fem/locomotion/locomotion_samples.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;
using namespace locomotion_samples;
using tests::message_of;

const std::string two_records = "[time]\nduration_s = 0.02\nrecord_interval_s = 0.01\n";
const std::string base = cube + silicone + ground + drive + two_records + no_pictures;

TEST(LocomotionSweep, PutsEachValueInPlaceOfTheStudys) {
  const LocomotionStudy study =
      sample_study(base + "[sweep]\nkeys = [\"ground.static_friction\", \"ground.kinetic_friction\"]\nvalues = [0.25, 1]\n");
  const auto studies = sweep_studies(study);
  ASSERT_EQ(studies.size(), 2U);
  EXPECT_EQ(studies[0].ground.friction.static_coefficient, 0.25);
  EXPECT_EQ(studies[0].ground.friction.kinetic_coefficient, 0.25);
  EXPECT_EQ(studies[1].ground.friction.kinetic_coefficient, 1.0);
  EXPECT_FALSE(studies[0].sweep);
  EXPECT_EQ(studies[0].inputs, study.inputs);
}

TEST(LocomotionSweep, RefusesKeysAndValuesThatTheStudyHasNot) {
  const auto message = [](const std::string& sweep) {
    return message_of([&] { (void)sweep_studies(sample_study(base + sweep)); });
  };
  EXPECT_NE(message("[sweep]\nkeys = [\"ground.stickiness\"]\nvalues = [1]\n").find("study.toml: ground.stickiness"),
            std::string::npos);
  EXPECT_NE(message("[sweep]\nkeys = [\"drive.mode\"]\nvalues = [1]\n").find("drive.mode: must be a number"), std::string::npos);
  const std::string negative = message("[sweep]\nkeys = [\"drive.frequency_Hz\"]\nvalues = [-1]\n");
  EXPECT_NE(negative.find("drive.frequency_Hz = -1"), std::string::npos) << negative;
  EXPECT_NE(message("[sweep]\nkeys = []\nvalues = [1]\n").find("sweep.keys"), std::string::npos);
  EXPECT_NE(message("[sweep]\nkeys = [\"drive.frequency_Hz\"]\nvalues = []\n").find("sweep.values"), std::string::npos);
}

// The second case is beyond what the walls bear, the third is not stopped by that.
TEST(LocomotionSweep, RunsEveryCaseAlsoAfterOneThatFailed) {
  const tests::TestFolder scratch;
  const fs::path folder = scratch / "new";
  std::string study = cube + silicone + ground +
                      "[drive]\nmode = \"hold\"\npressure_Pa = [0, 1000]\nfrequency_Hz = 50\nramp_s = 0.002\n" + two_records +
                      no_pictures + "[sweep]\nkeys = [\"loads.gravity_m_per_s2\"]\nvalues = [9.81, 2e5, 1.62]\n" +
                      "[loads]\ngravity_m_per_s2 = 9.81\n";
  const auto cases = run_sweep(sample_study(study), folder);
  ASSERT_EQ(cases.size(), 3U);
  const io::CsvContents csv = io::read_csv(folder / "sweep.csv");
  ASSERT_EQ(csv.row_count(), 3U);
  EXPECT_EQ(csv.text(0, "status"), "completed");
  EXPECT_NE(csv.text(1, "status"), "completed");
  EXPECT_FALSE(csv.optional_number(1, "direction_deg"));
  EXPECT_EQ(csv.text(2, "status"), "completed");
  EXPECT_EQ(csv.number(2, "loads.gravity_m_per_s2"), 1.62);
  EXPECT_TRUE(fs::exists(folder / "case_03/trajectory.csv"));
}

TEST(LocomotionSweep, RefusesACaseBeforeItRunsAnother) {
  const tests::TestFolder scratch;
  const fs::path folder = scratch / "new";
  io::write_whole(folder / "sweep.csv", "earlier");
  const std::string study = base + "[sweep]\nkeys = [\"drive.frequency_Hz\"]\nvalues = [20, 2e4]\n";
  const std::string message = message_of([&] { (void)run_sweep(sample_study(study), folder); });
  EXPECT_NE(message.find("a ramp of 5e-05 s"), std::string::npos) << message;
  EXPECT_EQ(io::read_whole(folder / "sweep.csv"), "earlier");
  EXPECT_FALSE(fs::exists(folder / "case_01"));
}

TEST(LocomotionSweep, GoesOnWithTheCaseThatWasStopped) {
  const tests::TestFolder scratch;
  const fs::path folder = scratch / "new";
  const LocomotionStudy study = sample_study(base + "[sweep]\nkeys = [\"ground.kinetic_friction\"]\nvalues = [0.1, 0.2]\n");
  std::atomic<bool> stop = false;
  const auto stopped = run_sweep(study, folder, {.stop = &stop}, [&](std::size_t, const SweepCase&) { stop = true; });
  ASSERT_EQ(stopped.size(), 2U);
  EXPECT_EQ(stopped[0].result.status, io::RunStatus::completed);
  EXPECT_EQ(stopped[1].result.status, io::RunStatus::stopped);
  const auto cases = run_sweep(study, folder);
  EXPECT_EQ(cases[1].result.status, io::RunStatus::completed);
  EXPECT_EQ(cases[0].result.seconds, stopped[0].result.seconds) << "was not computed again";
  EXPECT_EQ(io::program_of_manifest(folder / "manifest.json"), "menger-locomote");
  EXPECT_GE(io::seconds_of_manifest(folder / "manifest.json", "menger-locomote"),
            cases[0].result.seconds + cases[1].result.seconds)
      << "with the calls that it went on from";
}

TEST(LocomotionSweep, RefusesTheFolderOfAnotherCommand) {
  const tests::TestFolder scratch;
  const fs::path folder = scratch / "new";
  io::RunFolder("menger-simulate", folder).finish("", {});
  const std::string study = base + "[sweep]\nkeys = [\"ground.kinetic_friction\"]\nvalues = [0.1]\n";
  const std::string message = message_of([&] { (void)run_sweep(sample_study(study), folder); });
  EXPECT_NE(message.find("holds results of menger simulate"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(folder / "case_01"));
}

TEST(LocomotionSweep, DoesNotLieBesideAWalkOfAnEarlierStudy) {
  const tests::TestFolder scratch;
  const fs::path folder = scratch / "new";
  (void)run_locomotion(sample_study(base), folder);
  ASSERT_TRUE(fs::exists(folder / "locomotion.toml"));
  const std::string sweep = base + "[sweep]\nkeys = [\"ground.kinetic_friction\"]\nvalues = [0.1]\n";
  (void)run_sweep(sample_study(sweep), folder);
  EXPECT_FALSE(fs::exists(folder / "locomotion.toml"));
  EXPECT_TRUE(fs::exists(folder / "sweep.csv"));
  (void)run_locomotion(sample_study(base), folder);
  EXPECT_TRUE(fs::exists(folder / "locomotion.toml"));
  EXPECT_FALSE(fs::exists(folder / "sweep.csv"));
}

}  // namespace
}  // namespace menger::fem
