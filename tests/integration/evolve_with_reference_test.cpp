// A search corrected by rounds of reference evaluations: menger-evolve, menger-export and
// menger-compare-searches.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "io/text/csv_table.h"
#include "io/text/whole_file.h"
#include "tests/support/archive_content.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::archive_content;
using test_support::Outcome;
using test_support::ProgramRun;

/// A search of silicone robots over the first rise of the pressure, which finite elements compute in a second.
class EvolveWithReference : public testing::Test {
 protected:
  EvolveWithReference() {
    write_study("every = 1\ndesigns = 2\nbudget_element_steps = 1e8\n");
    io::write_whole(folder_ / "reference.toml", "[time]\nrecord_interval_s = 0.005\n");
  }

  void write_study(const std::string& reference) const {
    io::write_whole(
        folder_ / "study.toml",
        "preset = \"paper\"\ngenerations = 2\n[population]\nsurvivors = 4\nmutants = 4\n"
        "[body]\nlevels = [1]\ncastable = true\n[evaluation]\nstand = true\n[time]\nduration_s = 0.06\nmeasure_from_s = 0.01\n"
        "[surrogate]\nparameters = \"" MENGER_SOURCE_DIR
        "/voxel/parameters/dragon_skin_10_1cm.toml\"\nchambers = \"single\"\n"
        "outside_range = \"warn\"\n[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 6000]\nfrequency_Hz = 10\nramp_s = 0.02\n"
        "[reference]\nstudy = \"reference.toml\"\n" +
            reference);
  }

  [[nodiscard]] ProgramRun start(const std::string& program, std::vector<std::string> arguments) const {
    return {folder_, fs::path(MENGER_PROGRAM_DIR) / ("menger-" + program), std::move(arguments)};
  }
  [[nodiscard]] Outcome run(const std::string& program, std::vector<std::string> arguments) const {
    return start(program, std::move(arguments)).wait();
  }

  const tests::TestFolder folder_;
};

TEST_F(EvolveWithReference, FiniteElementsReferenceSurvivorsAndCorrectTheFitness) {
  const Outcome outcome = run("evolve", {"study.toml", "--threads", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* words : {"before generation 1: reference evaluations: 2", "before generation 2: reference evaluations: 2",
                            "correction: median ratio", "4 reference evaluations", "element-steps of 2.6 voxel-steps each"})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out << "\ndoes not say: " << words;
  const evolution::RunArchive archive = evolution::RunArchive::open_to_read(folder_ / "run.sqlite");
  const std::vector<evolution::ReferenceEvaluation> evaluations = archive.reference_evaluations();
  ASSERT_EQ(evaluations.size(), 4U);
  for (const evolution::ReferenceEvaluation& one : evaluations) {
    EXPECT_TRUE(one.score) << one.found.result.reason;
    EXPECT_TRUE(one.found.result.left_out_m);
    // The coarsest body has some hundred elements, and a step is about 10 us.
    EXPECT_GT(one.element_steps, 100'000U);
    EXPECT_NE(one.found.protocol.find("measure_from_s = 0.01"), std::string::npos);
  }
  EXPECT_EQ(archive.reevaluations().size(), 4U);

  ASSERT_EQ(run("export", {"run.sqlite", "-o", "out", "--levels", "1", "--no-frames", "--no-pictures"}).code, 0);
  const io::CsvContents table = io::read_csv(folder_ / "out/reference.csv");
  ASSERT_EQ(table.row_count(), 4U);
  EXPECT_NEAR(table.number(0, "reference_body_lengths"), evaluations[0].score.value(), 1e-15);
  EXPECT_TRUE(io::read_csv(folder_ / "out/generations.csv").has("champion_reference_fitness_body_lengths"));
  const Outcome compared = run("compare-searches", {"out", "-o", "comparison", "--no-pictures"});
  ASSERT_EQ(compared.code, 0) << compared.err;
  EXPECT_EQ(io::read_csv(folder_ / "comparison/comparison.csv").text(0, "evaluated"), "4");
}

TEST_F(EvolveWithReference, IsTheSameForTwoThreadsAndAfterAnInterruption) {
  ASSERT_EQ(run("evolve", {"study.toml", "--threads", "2", "-o", "two.sqlite"}).code, 0);
  const ProgramRun running = start("evolve", {"study.toml", "--threads", "1", "-o", "stopped.sqlite"});
  while (!fs::exists(folder_ / "stopped.reference")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  running.send(SIGINT);
  const Outcome stopped = running.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.out << stopped.err;
  EXPECT_TRUE(evolution::RunArchive::open_to_read(folder_ / "stopped.sqlite").reference_evaluations().empty());
  ASSERT_EQ(run("evolve", {"study.toml", "--threads", "1", "-o", "stopped.sqlite"}).code, 0);
  EXPECT_EQ(archive_content(folder_ / "stopped.sqlite"), archive_content(folder_ / "two.sqlite"));
}

TEST_F(EvolveWithReference, WhereTheBudgetIsSpentTheSearchGoesOnAndSaysSo) {
  write_study("every = 1\ndesigns = 1\nbudget_element_steps = 1e3\n");
  const Outcome outcome = run("evolve", {"study.toml", "--threads", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("before generation 2: the budget of reference evaluations is used up"), std::string::npos)
      << outcome.out;
  EXPECT_EQ(evolution::RunArchive::open_to_read(folder_ / "run.sqlite").last_generation(), 2);
}

TEST_F(EvolveWithReference, WrongInputIsFoundBeforeAnythingIsWritten) {
  const auto expect_refused = [&](const std::string& word) {
    const Outcome outcome = run("evolve", {"study.toml"});
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "run.sqlite"));
  };
  io::write_whole(folder_ / "reference.toml", "record_interval = 0.005\n");
  expect_refused("record_interval");
  io::write_whole(folder_ / "reference.toml", "[time]\nrecord_interval_s = 0.003\n");
  expect_refused("a multiple of record_interval_s = 0.003");
  fs::remove(folder_ / "reference.toml");
  expect_refused("reference.toml");
  write_study("every = 1\n");
  expect_refused("reference.budget_element_steps");
}

}  // namespace
}  // namespace menger
