#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "io/device/graphics_processor.h"
#include "io/text/content_hash.h"
#include "io/text/manifest.h"
#include "io/text/whole_file.h"
#include "tests/support/archive_content.h"
#include "tests/support/earlier_archive.h"
#include "tests/support/program_run.h"
#include "tests/support/surrogate_example.h"
#include "tests/support/test_folder.h"
#include "voxel/model/expected_errors.h"
#include "voxel/model/surrogate_file.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::archive_content;
using test_support::Outcome;
using test_support::ProgramRun;

constexpr const char* small_study = R"(preset = "paper"
generations = 2
[population]
survivors = 3
mutants = 3
[body]
levels = [1, 2]
[time]
duration_s = 0.05
)";

/// The program in a folder of its own, with a small study in it.
class Evolve : public testing::Test {
 protected:
  Evolve() { io::write_whole(study_, small_study); }

  [[nodiscard]] ProgramRun start(std::vector<std::string> arguments) const {
    return {folder_, fs::path(MENGER_PROGRAM_DIR) / "menger-evolve", std::move(arguments)};
  }
  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const { return start(std::move(arguments)).wait(); }

  /// Expects that the program refuses with these words and leaves the archive as it was.
  void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) const {
    const bool there = fs::exists(archive_);
    const std::string before = there ? io::read_whole(archive_) : "";
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.err.rfind("menger-evolve: error: ", 0), 0U) << outcome.err;
    for (const std::string& word : words) {
      EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err << "\ndoes not say: " << word;
    }
    ASSERT_EQ(fs::exists(archive_), there);
    if (there) {
      EXPECT_EQ(io::read_whole(archive_), before);
    }
    EXPECT_EQ(fs::exists(folder_ / "run.manifest.json"), there);
  }

  void change_study(const std::string& from, const std::string& to) const {
    std::string text = small_study;
    text.replace(text.find(from), from.size(), to);
    io::write_whole(study_, text);
  }

  const tests::TestFolder folder_;
  fs::path study_ = folder_ / "study.toml";
  fs::path archive_ = folder_ / "run.sqlite";
};

TEST_F(Evolve, WritesAnArchiveAndAManifestAndALinePerGeneration) {
  const Outcome outcome = run({"study.toml"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(evolution::RunArchive::open_to_read(archive_).last_generation(), 2);
  for (const std::string word :
       {"Poisson", "F [BL]", "d1 [BL]", "d2 [BL]", "\n   0 ", "\n   1 ", "\n   2 ", "Champion: individual "}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << outcome.out << "\ndoes not say: " << word;
  }
  const std::string legend = "gen: generation; F: fitness of the fittest survivor; d1, d2: its displacement at these levels";
  const auto at = outcome.out.find(legend);
  EXPECT_LT(at, outcome.out.find("F [BL]")) << outcome.out;
  EXPECT_EQ(outcome.out.find(legend, at + 1), std::string::npos) << "said twice";
  EXPECT_EQ(outcome.out.find('\r'), std::string::npos) << "a bar in a file";
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(io::read_whole(folder_ / "run.manifest.json").find("\"duration_s\": 0.05"), std::string::npos);
}

TEST_F(Evolve, OfACalibratedStudyBelongsToItsParameters) {
  voxel::SurrogateParameters parameters = tests::surrogate_example();
  parameters.validity.smallest_strain = -1e-9;
  io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(parameters));
  io::write_whole(study_, std::string(small_study) +
                              "[surrogate]\nparameters = \"soft.toml\"\noutside_range = \"warn\"\n"
                              "[drive]\npressure_Pa = [0, 1500]\nmode = \"in_phase\"\n");
  const Outcome outcome = run({"study.toml"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* words : {"evaluations were outside the range of validity",
                            "The champion is outside the range of validity of its model: level 1: "})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out;
  const std::string hash = io::content_hash(io::read_whole(folder_ / "soft.toml"));
  EXPECT_NE(io::read_whole(folder_ / "run.manifest.json").find(hash), std::string::npos) << "names the parameters' content";

  // What is known of the errors of the voxels decides nothing.
  EXPECT_NE(outcome.out.find("warning: the error of the voxels is unknown: no table of errors"), std::string::npos)
      << outcome.out;
  voxel::ExpectedErrors errors{.parameters_hash = voxel::hash_of(parameters)};
  voxel::expected_errors_table(errors).write(folder_ / "soft.errors.csv");
  ASSERT_EQ(run({"study.toml"}).code, 0);
  parameters.torsion_Pa[3] *= 1.01;
  io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(parameters));
  expect_refused({"study.toml"}, {"run.sqlite", "is the archive of another study", "torsion_Pa"});
}

TEST_F(Evolve, SaysWhichErrorToExpectOfCalibratedVoxels) {
  const voxel::SurrogateParameters parameters = tests::surrogate_example();
  io::write_whole(folder_ / "soft.toml", voxel::surrogate_text(parameters));
  voxel::ExpectedErrors errors{.parameters_hash = voxel::hash_of(parameters)};
  for (auto& of_kind : errors.kinds)
    of_kind = {.bodies = {"x"}, .displacements = 4, .displacement_median = 0.25, .displacement_ninth_decile = 0.5};
  voxel::expected_errors_table(errors).write(folder_ / "soft.errors.csv");
  change_study("levels = [1, 2]", "levels = [1]");
  io::write_whole(study_, io::read_whole(study_) +
                              "[surrogate]\nparameters = \"soft.toml\"\noutside_range = \"warn\"\n"
                              "[drive]\npressure_Pa = [0, 1500]\nmode = \"in_phase\"\n");
  const Outcome outcome = run({"study.toml"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::size_t first_line = outcome.out.find("  plates on legs: 25 % in displacement");
  EXPECT_LT(first_line, outcome.out.find("writing run.sqlite")) << "before it starts\n" << outcome.out;
  EXPECT_NE(outcome.out.find("warning: the voxels are a poor model of plates on legs"), std::string::npos);
  EXPECT_NE(outcome.out.find("expected error for a"), std::string::npos) << "of the champion\n" << outcome.out;
  const std::string manifest = io::read_whole(folder_ / "run.manifest.json");
  EXPECT_NE(manifest.find("plates on legs: 25 % in displacement"), std::string::npos) << manifest;
  EXPECT_NE(manifest.find("soft.errors.csv"), std::string::npos);
}

TEST_F(Evolve, ASecondCallShowsInsteadOfRedoing) {
  ASSERT_EQ(run({"study.toml"}).code, 0);
  const std::string content = archive_content(archive_);
  const auto manifest_time = fs::last_write_time(folder_ / "run.manifest.json");
  const Outcome outcome = run({"study.toml"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("nothing to do"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\n   2 "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("Champion: individual "), std::string::npos);
  EXPECT_EQ(archive_content(archive_), content);
  EXPECT_EQ(fs::last_write_time(folder_ / "run.manifest.json"), manifest_time);
}

TEST_F(Evolve, MoreGenerationsContinueTheRun) {
  ASSERT_EQ(run({"study.toml"}).code, 0);
  const Outcome outcome = run({"study.toml", "--generations", "3", "--threads", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("resuming "), std::string::npos) << outcome.out;
  ASSERT_EQ(run({"study.toml", "-g", "3", "-o", "straight.sqlite"}).code, 0);
  EXPECT_EQ(archive_content(archive_), archive_content(folder_ / "straight.sqlite"));
}

TEST_F(Evolve, InterruptedItEndsCleanlyAndGoesOnLater) {
  const ProgramRun running = start({"study.toml", "--generations", "100000", "--threads", "2"});
  while (running.printed().find("\n   1 ") == std::string::npos) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  running.send(SIGINT);
  const Outcome stopped = running.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_NE(stopped.out.find("Run the same command again to resume."), std::string::npos) << stopped.out;
  EXPECT_TRUE(fs::exists(folder_ / "run.manifest.json"));

  const int last = evolution::RunArchive::open_to_read(archive_).last_generation().value();
  ASSERT_LT(last, 100000);
  const std::string goal = std::to_string(last + 2);
  ASSERT_EQ(run({"study.toml", "--generations", goal}).code, 0);
  ASSERT_EQ(run({"study.toml", "--generations", goal, "-o", "whole.sqlite"}).code, 0);
  EXPECT_EQ(archive_content(archive_), archive_content(folder_ / "whole.sqlite"));
}

TEST_F(Evolve, TheManifestHasTheTimeOfAllCalls) {
  const fs::path manifest = folder_ / "run.manifest.json";
  io::write_whole(manifest, R"({"program": "menger-evolve", "seconds": 5e6})");
  ASSERT_EQ(run({"study.toml", "-g", "1"}).code, 0);
  const double first_s = io::seconds_of_manifest(manifest, "menger-evolve");
  EXPECT_GT(first_s, 0.0);
  EXPECT_LT(first_s, 1e6) << "that was of another archive of this name";
  io::write_whole(manifest, R"({"program": "menger-evolve", "seconds": 36000.0})");
  ASSERT_EQ(run({"study.toml", "-g", "2"}).code, 0);
  EXPECT_GT(io::seconds_of_manifest(manifest, "menger-evolve"), 36000.0);
  EXPECT_LT(io::seconds_of_manifest(manifest, "menger-evolve"), 72000.0);
}

TEST_F(Evolve, SearchesWhoseNamesDifferInTheirEndingsHaveManifestsOfTheirOwn) {
  for (const char* name : {"trial.1", "trial.2"}) ASSERT_EQ(run({"study.toml", "-g", "0", "-o", name}).code, 0);
  for (const char* name : {"trial.1.manifest.json", "trial.2.manifest.json"}) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  EXPECT_FALSE(fs::exists(folder_ / "trial.manifest.json"));
}

// A population of this size is grown for minutes before the first robot walks.
TEST_F(Evolve, InterruptedWhileItGrowsAnEnormousPopulationItLeavesAWholeArchive) {
  io::write_whole(folder_ / "large.toml",
                  "preset = \"paper\"\ngenerations = 1\n[population]\nsurvivors = 500000\nmutants = 500000\n");
  const ProgramRun running = start({"large.toml", "-o", "large.sqlite"});
  running.wait_for_processor_seconds(1.0);
  running.send(SIGINT);
  const Outcome stopped = running.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.signal << stopped.err;
  EXPECT_FALSE(evolution::RunArchive::open_to_read(folder_ / "large.sqlite").last_generation());
}

TEST_F(Evolve, RefusesBadStudies) {
  change_study("generations", "generation");
  expect_refused({"study.toml"}, {"study.toml:2: ", "generation: unknown key", "generations"});
  change_study("generations = 2", "generations = \"two\"");
  expect_refused({"study.toml"}, {"study.toml:2: ", "generations = ", "two", "integer"});
  change_study("[body]", "[materials]\nyoungs_modulus_Pa = -1\n[body]");
  expect_refused({"study.toml"}, {"study.toml:7: ", "materials.youngs_modulus_Pa = -1", "> 0"});
  change_study("[1, 2]", "[1, 9]");
  expect_refused({"study.toml"}, {"study.toml:7: ", "body.levels", "9", "memory"});
  change_study("[body]", "[body");
  expect_refused({"study.toml"}, {"study.toml:6", "TOML"});
  expect_refused({"missing.toml"}, {"missing.toml"});
}

TEST_F(Evolve, RefusesBadArguments) {
  expect_refused({}, {"study"});
  expect_refused({"study.toml", "--thread", "2"}, {"--thread"});
  expect_refused({"study.toml", "--threads", "0"}, {"--threads", "0"});
  expect_refused({"study.toml", "--generations", "-1"}, {"generations = -1"});
  expect_refused({"study.toml", "--device", "gpu"}, {"--device", "gpu"});
}

TEST_F(Evolve, RefusesAGraphicsProcessorThatIsNotThere) {
  const std::string obstacle = io::obstacle_to_device();
  if (obstacle.empty()) GTEST_SKIP() << "there is one";
  expect_refused({"study.toml", "--device", "cuda"}, {"--device cuda: " + obstacle});
  io::write_whole(study_, std::string(small_study) + "[evaluation]\ndevice = \"cuda\"\n");
  expect_refused({"study.toml"}, {"study.toml: evaluation.device = \"cuda\": " + obstacle});
  EXPECT_FALSE(fs::exists(archive_));
}

TEST_F(Evolve, RefusesPlacesWhereNothingCanBeWritten) {
  expect_refused({"study.toml", "-o", "study.toml/run.sqlite"}, {"study.toml"});
  expect_refused({"study.toml", "-o", "."}, {"folder"});
  EXPECT_EQ(io::read_whole(study_), small_study);
}

TEST_F(Evolve, RefusesAnArchiveOfAnotherStudy) {
  ASSERT_EQ(run({"study.toml"}).code, 0);
  change_study("duration_s = 0.05", "duration_s = 0.06");
  expect_refused({"study.toml"}, {"run.sqlite", "another study", "duration_s = 0.05", "duration_s = 0.06"});
}

TEST_F(Evolve, RefusesAnArchiveOfAnotherSchemaVersion) {
  ASSERT_EQ(run({"study.toml"}).code, 0);
  const std::string next = std::to_string(evolution::RunArchive::schema_version + 1);
  SQLite::Database(archive_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = " + next);
  expect_refused({"study.toml"}, {"run.sqlite", "schema version " + next});
}

TEST_F(Evolve, RefusesToGoOnWithAnArchiveFromBeforeKeysHadTheirNames) {
  ASSERT_EQ(run({"study.toml"}).code, 0);
  tests::make_earlier(archive_, tests::demo_study_of_version_3);
  expect_refused({"study.toml"}, {"run.sqlite", "schema version 3", "no search can be resumed from it"});
}

TEST_F(Evolve, RunsItsOwnTemplate) {
  const Outcome outcome = run({"--template"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  io::write_whole(study_, outcome.out);
  const Outcome search = run({"study.toml", "-g", "1", "--levels", "1", "--duration", "0.05"});
  EXPECT_EQ(search.code, 0) << search.err;
  EXPECT_EQ(evolution::RunArchive::open_to_read(archive_).last_generation(), 1);
}

TEST_F(Evolve, RefusesADamagedArchive) {
  ASSERT_EQ(run({"study.toml"}).code, 0);
  fs::resize_file(archive_, fs::file_size(archive_) / 3);
  expect_refused({"study.toml"}, {"run.sqlite"});
  io::write_whole(archive_, "once upon a time");
  expect_refused({"study.toml"}, {"run.sqlite", "not an archive"});
}

TEST_F(Evolve, RefusesAnArchiveThatAnotherProcessWritesTo) {
  const ProgramRun running = start({"study.toml", "--generations", "100000"});
  while (running.printed().find("\n   0 ") == std::string::npos) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const fs::path other = folder_ / "other";
  fs::create_directories(other);
  const Outcome second =
      ProgramRun(other, fs::path(MENGER_PROGRAM_DIR) / "menger-evolve", {study_.string(), "-o", archive_.string()}).wait();
  EXPECT_EQ(second.code, 2) << second.out;
  EXPECT_NE(second.err.find("another process"), std::string::npos) << second.err;
  running.send(SIGTERM);
  EXPECT_EQ(running.wait().code, 130);
}

TEST_F(Evolve, HelpHasAnExample) {
  const Outcome outcome = run({"--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("menger evolve paper/demo/study.toml"), std::string::npos) << outcome.out;
}

TEST_F(Evolve, AllStudiesOfThePaperRunAtReducedSize) {
  for (const std::string name : {"fractal", "non_fractal", "phase_wave", "single_actuator"}) {
    const fs::path study = fs::path(MENGER_SOURCE_DIR) / "paper" / name / "small.toml";
    const Outcome outcome = run({study.string(), "-g", "1", "--levels", "1", "--duration", "0.02", "-o", name + ".sqlite"});
    EXPECT_EQ(outcome.code, 0) << name << ": " << outcome.err;
    EXPECT_NE(outcome.out.find("Champion"), std::string::npos) << outcome.out;
  }
}

}  // namespace
}  // namespace menger
