#include "evolution/reevaluation/reevaluation_run.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <thread>

#include "io/process/file_lock.h"
#include "io/text/csv_table.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/silicone_archive.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

std::size_t cells_of(const LocomotionJob& job) { return job.study.design.body.occupied().size(); }

/// A law in place of finite elements: n cells move n mm along x in 0.1 s and a hundredth of that along y, times the square root
/// of E / 260 kPa.
fem::LocomotionResult fake_walk(const LocomotionJob& job) {
  const double modulus_Pa = job.study.silicone.youngs_modulus_Pa.value_or(260e3);
  const std::size_t through = job.study.elements.fidelity == fem::Fidelity::fine ? 2 : 1;
  const double x_m = static_cast<double>(cells_of(job)) * 1e-3 * std::sqrt(modulus_Pa / 260e3);
  fem::LocomotionResult result;
  result.status = io::RunStatus::completed;
  result.time_s = 0.1;
  result.steps = 1000 * through;
  result.elements = 10 * through;
  result.body_length_m = 0.03;
  result.seconds = 0.5;
  for (int i = 0; i <= 5; ++i)
    result.records.push_back({.time_s = 0.02 * i, .centre_of_mass_m = {0.015 + x_m * i / 5.0, 0.015 + x_m * i / 500.0, 0.005}});
  return result;
}

/// A walk that ends early, with a record of its start.
fem::LocomotionResult early_end(io::RunStatus status, const std::string& reason) {
  fem::LocomotionResult result;
  result.status = status;
  result.reason = reason;
  result.time_s = 0.01;
  result.steps = 7;
  result.elements = 3;
  result.body_length_m = 0.03;
  result.seconds = 0.1;
  result.records.push_back({});
  return result;
}

/// A walk that goes on until it is stopped.
fem::LocomotionResult endless_walk(const std::atomic<bool>& stop) {
  while (!stop) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return early_end(io::RunStatus::stopped, "interrupted");
}

const std::string cell = "100000000000000000000000000";
const std::string bar_2 = "110000000000000000000000000";
const std::string bar_3 = "111000000000000000000000000";
const std::string plate_4 = "110110000000000000000000000";
const std::string plate_6 = "111111000000000000000000000";
const std::string weak = "100010000000000000000000000";

/// An archive of silicone robots, and a law in place of finite elements, whose calls are counted.
class ReevaluationRun : public testing::Test {
 protected:
  ReevaluationRun() {
    walk_as([](const LocomotionJob& job, const std::atomic<bool>&) { return fake_walk(job); });
    tests::make_archive(archive_, tests::silicone_study(), {bar_3, weak, bar_2, plate_4, cell, plate_6});
    options_.pictures = false;
  }

  /// Lets designs walk in another way from now on.
  void walk_as(const std::function<fem::LocomotionResult(const LocomotionJob&, const std::atomic<bool>&)>& walk) {
    options_.walker = [this, walk](const LocomotionJob& job, const fs::path&, const std::atomic<bool>& stop) {
      ++calls_;
      return walk(job, stop);
    };
  }

  /// @param top_keys of the study @param more keys of [time] or tables
  [[nodiscard]] ReevaluationResult run(std::size_t top, std::size_t sample = 0, const std::string& more = "",
                                       const std::string& top_keys = "") const {
    // a few steps are enough for the surrogate to differ from the script
    io::write_whole(folder_ / "study.toml", "least_body_lengths = " + least_ + "\n" + top_keys +
                                                "[time]\nduration_s = 0.1\nrecord_interval_s = 0.02\n" + more);
    RunArchive archive = RunArchive::open_to_read(archive_);
    const ReevaluationStudy study =
        read_reevaluation_study({.archive = archive_, .file = folder_ / "study.toml", .top = top, .sample = sample}, archive);
    return reevaluate(study, std::move(archive), folder_ / "out", options_);
  }

  [[nodiscard]] std::size_t calls() const { return calls_; }
  [[nodiscard]] io::CsvContents table(const char* name) const { return io::read_csv(folder_ / "out" / name); }

  const tests::TestFolder folder_;
  fs::path archive_ = folder_ / "run.sqlite";
  std::atomic<std::size_t> calls_{0};
  ReevaluationOptions options_;
  std::string least_ = "0.001";  ///< least displacement with a direction, in body lengths
};

TEST_F(ReevaluationRun, EvaluatesTheBestAndASampleInBothModels) {
  options_.jobs = 3;
  const ReevaluationResult result = run(2, 2);
  EXPECT_EQ(result.status, io::RunStatus::completed);
  EXPECT_EQ(result.repeated, 4U);
  const io::CsvContents found = table("reevaluation.csv");
  ASSERT_EQ(found.row_count(), 4U);
  EXPECT_EQ(found.text(0, "individual"), "0");
  EXPECT_EQ(found.text(1, "individual"), "2") << "rank 2 cannot be cast";
  EXPECT_EQ(found.text(1, "selection"), "top");
  EXPECT_EQ(found.text(2, "selection"), "sample");
  EXPECT_EQ(found.number(0, "fitness_body_lengths"), 1.0);
  // computed by hand: 3 cells move 3 mm, a tenth of a body length in a tenth of a second
  EXPECT_NEAR(found.number(0, "elements_dx_m"), 3e-3, 1e-12);
  EXPECT_NEAR(found.number(0, "elements_body_lengths"), 0.1 * std::hypot(1.0, 0.01), 1e-9);
  EXPECT_NEAR(found.number(0, "elements_body_lengths_per_minute"), 60.0 * std::hypot(1.0, 0.01), 1e-6);
  EXPECT_NEAR(found.number(0, "elements_direction_deg"), std::atan(0.01) * 57.29577951308232, 1e-9);
  EXPECT_EQ(found.number(0, "elements_least_dz_m"), 0.0) << "the script moves level";
  EXPECT_LE(found.number(0, "surrogate_least_dz_m"), 0.0);
  EXPECT_EQ(found.text(0, "elements_steps"), "1000");
  EXPECT_EQ(found.text(0, "elements_seconds"), "0.5");
  EXPECT_EQ(found.text(0, "surrogate_status"), "completed");
  EXPECT_GT(found.number(0, "surrogate_steps"), 10.0);
  EXPECT_EQ(found.text(0, "body"), "111,000,000/000,000,000/000,000,000");
  ASSERT_EQ(table("refused.csv").row_count(), 1U);
  EXPECT_EQ(table("refused.csv").text(0, "rank"), "2");
  for (const char* file : {"summary.txt", "winner/design.toml", "trajectories/rank_0001.csv"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
  EXPECT_FALSE(fs::exists(folder_ / "out/variants.csv"));
}

TEST_F(ReevaluationRun, TheNumbersOfATableFollowFromItsDisplacements) {
  // In a tenth of a second the surrogate hardly moves, so every displacement above rounding counts.
  least_ = "1e-9";
  constexpr double least_m = 1e-9 * 0.03;
  (void)run(5);
  const io::CsvContents found = table("reevaluation.csv");
  std::vector<double> surrogate;
  std::vector<double> elements;
  for (std::size_t row = 0; row < found.row_count(); ++row) {
    const double ax = found.number(row, "surrogate_dx_m");
    const double ay = found.number(row, "surrogate_dy_m");
    const double bx = found.number(row, "elements_dx_m");
    const double by = found.number(row, "elements_dy_m");
    EXPECT_NEAR(found.number(row, "surrogate_distance_m"), std::hypot(ax, ay), 1e-15);
    if (const auto ratio = found.optional_number(row, "distance_ratio")) {
      EXPECT_NEAR(*ratio, std::hypot(bx, by) / std::hypot(ax, ay), 1e-9 * *ratio);
    }
    if (const auto angle = found.optional_number(row, "angle_deg")) {
      const double cosine = (ax * bx + ay * by) / std::hypot(ax, ay) / std::hypot(bx, by);
      EXPECT_NEAR(std::cos(*angle / 57.29577951308232), cosine, 1e-9);
    }
    EXPECT_NEAR(found.number(row, "surrogate_relative_error"), std::hypot(ax - bx, ay - by) / std::hypot(bx, by), 1e-9);
    surrogate.push_back(std::hypot(ax, ay) < least_m ? 0.0 : std::hypot(ax, ay));
    elements.push_back(std::hypot(bx, by));
  }
  const io::CsvContents ranking = table("ranking.csv");
  EXPECT_EQ(ranking.text(0, "quantity"), "spearman");
  EXPECT_NEAR(ranking.number(0, "value"), spearman_correlation(surrogate, elements).value().value, 1e-12);
  EXPECT_NEAR(ranking.number(1, "value"), kendall_correlation(surrogate, elements).value().value, 1e-12);
  EXPECT_EQ(ranking.text(0, "count"), "5");
  const io::CsvContents clock = table("trajectories/rank_0001.csv");
  ASSERT_EQ(clock.row_count(), 6U);
  EXPECT_EQ(clock.number(0, "separation_m"), 0.0);
  EXPECT_NEAR(clock.number(5, "elements_dx_m"), 3e-3, 1e-12);
  // at the last record both models have a position, interpolated or not
  EXPECT_NEAR(clock.number(5, "surrogate_dx_m"), found.number(0, "surrogate_dx_m"), 1e-6);
}

TEST_F(ReevaluationRun, AFallShowsInTheLowestHeight) {
  walk_as([](const LocomotionJob& job, const std::atomic<bool>&) {
    fem::LocomotionResult result = fake_walk(job);
    result.records.push_back({.time_s = 0.12, .centre_of_mass_m = {0.018, 0.015, 0.003}});
    result.records.push_back({.time_s = 0.14, .centre_of_mass_m = {0.018, 0.015, 0.006}});
    return result;
  });
  (void)run(1);
  EXPECT_NEAR(table("reevaluation.csv").number(0, "elements_least_dz_m"), -0.002, 1e-12);
}

TEST_F(ReevaluationRun, WhatIsLeftOutIsTakenFromBothModelsAndRecorded) {
  (void)run(1, 0, "measure_from_s = 0.04\n");
  const io::CsvContents found = table("reevaluation.csv");
  // computed by hand: 3 cells move 3 mm at constant speed in 0.1 s, and 0.06 s of this count
  EXPECT_NEAR(found.number(0, "elements_dx_m"), 1.8e-3, 1e-12);
  EXPECT_NEAR(found.number(0, "elements_left_out_m"), 1.2e-3 * std::hypot(1.0, 0.01), 1e-12);
  EXPECT_NEAR(found.number(0, "elements_body_lengths_per_minute"), 60.0 * std::hypot(1.0, 0.01), 1e-6) << "as fast as ever";
  const double part_m = found.number(0, "surrogate_dx_m");
  EXPECT_TRUE(found.optional_number(0, "surrogate_left_out_m"));
  const std::vector<Reevaluation> rows = RunArchive::open_to_read(archive_).reevaluations();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_NEAR(rows[0].result.displacement_m.value()[0], 1.8e-3, 1e-12);
  EXPECT_NEAR(rows[0].result.left_out_m.value()[0], 1.2e-3, 1e-12);
  EXPECT_EQ(calls(), 1U);
  (void)run(1);
  EXPECT_EQ(calls(), 1U) << "the same run serves another window";
  EXPECT_EQ(table("reevaluation.csv").text(0, "elements_left_out_m"), "");
  EXPECT_NE(table("reevaluation.csv").number(0, "surrogate_dx_m"), part_m);
  EXPECT_EQ(RunArchive::open_to_read(archive_).reevaluations().size(), 2U) << "another protocol";
}

TEST_F(ReevaluationRun, IsTheSameForAnyNumberOfJobs) {
  const auto without_seconds = [&] {
    std::string text;
    const io::CsvContents found = table("reevaluation.csv");
    for (std::size_t row = 0; row < found.row_count(); ++row) {
      for (const std::string& column : found.columns())
        if (!column.ends_with("seconds")) text += found.text(row, column) + ",";
    }
    return text + io::read_whole(folder_ / "out/ranking.csv") + io::read_whole(folder_ / "out/trajectories/rank_0003.csv");
  };
  (void)run(4);
  const std::string one = without_seconds();
  fs::remove_all(folder_ / "out");
  options_.jobs = 4;
  (void)run(4);
  EXPECT_EQ(without_seconds(), one);
}

TEST_F(ReevaluationRun, ASecondCallRepeatsNothing) {
  (void)run(3);
  EXPECT_EQ(calls(), 3U);
  const std::string before = io::read_whole(folder_ / "out/ranking.csv");
  EXPECT_EQ(run(3).repeated, 0U);
  EXPECT_EQ(run(4).repeated, 1U) << "one more design";
  EXPECT_EQ(calls(), 4U);
  (void)run(3);
  EXPECT_EQ(io::read_whole(folder_ / "out/ranking.csv"), before);
  EXPECT_FALSE(fs::exists(folder_ / "out/trajectories/rank_0005.csv")) << "of the call before";
}

TEST_F(ReevaluationRun, AFailedDesignDoesNotEndTheOthers) {
  walk_as([](const LocomotionJob& job, const std::atomic<bool>&) {
    if (cells_of(job) == 2) return early_end(io::RunStatus::diverged, "too fast");
    if (cells_of(job) == 4) throw std::runtime_error("broken");
    if (cells_of(job) == 1) throw io::InputError("too small");
    return fake_walk(job);
  });
  const ReevaluationResult result = run(5);
  EXPECT_EQ(result.status, io::RunStatus::completed);
  const io::CsvContents found = table("reevaluation.csv");
  ASSERT_EQ(found.row_count(), 5U);
  std::map<std::string, std::size_t> row_of_cells;
  for (std::size_t row = 0; row < 5; ++row) row_of_cells[found.text(row, "cells")] = row;
  EXPECT_EQ(found.text(row_of_cells.at("2"), "elements_status"), "diverged");
  EXPECT_EQ(found.text(row_of_cells.at("2"), "elements_reason"), "too fast");
  EXPECT_EQ(found.text(row_of_cells.at("2"), "elements_dx_m"), "");
  EXPECT_EQ(found.text(row_of_cells.at("4"), "elements_status"), "failed");
  EXPECT_EQ(found.text(row_of_cells.at("4"), "elements_reason"), "broken");
  EXPECT_EQ(found.text(row_of_cells.at("1"), "elements_status"), "failed") << "it was refused";
  EXPECT_EQ(found.text(row_of_cells.at("1"), "elements_reason"), "too small");
  EXPECT_EQ(found.text(row_of_cells.at("6"), "elements_status"), "completed");
  EXPECT_EQ(table("ranking.csv").text(0, "count"), "2") << "those that completed in both models";
  std::size_t with_result = 0;
  for (const Reevaluation& row : RunArchive::open_to_read(archive_).reevaluations())
    if (row.has_result) ++with_result;
  EXPECT_EQ(with_result, 3U);
}

TEST_F(ReevaluationRun, WhereNothingCompletesTheOutcomeIsNumerical) {
  walk_as([](const LocomotionJob&, const std::atomic<bool>&) -> fem::LocomotionResult { throw std::runtime_error("broken"); });
  const ReevaluationResult result = run(2);
  EXPECT_EQ(result.status, io::RunStatus::not_converged);
  EXPECT_EQ(table("reevaluation.csv").row_count(), 2U);
  EXPECT_EQ(table("ranking.csv").text(0, "value"), "");
}

TEST_F(ReevaluationRun, VariantsTellTheReferencesOwnError) {
  const ReevaluationResult result = run(3, 0, "[variants]\ndesigns = 2\nyoungs_moduli_Pa = [65e3, 260e3]\n");
  EXPECT_EQ(result.repeated, 3U + 2U * 7U);
  const io::CsvContents found = table("variants.csv");
  ASSERT_EQ(found.row_count(), 16U) << "two designs by the reference evaluator and seven variants";
  EXPECT_EQ(found.text(0, "variant"), "reference");
  EXPECT_EQ(found.number(0, "relative_change"), 0.0);
  EXPECT_EQ(found.text(1, "variant"), "fidelity fine");
  EXPECT_EQ(found.text(1, "steps"), "2000");
  EXPECT_EQ(found.text(6, "variant"), "E 65 kPa");
  EXPECT_EQ(found.text(6, "kind"), "stiffness");
  EXPECT_NEAR(found.number(6, "relative_change"), 0.5, 1e-9) << "a quarter of the modulus, half the displacement";
  EXPECT_EQ(found.text(8, "rank"), "3") << "the next that can be evaluated";
  const std::vector<ReferenceError> errors =
      reference_errors(read_reevaluation_study({.archive = archive_, .file = folder_ / "study.toml", .top = 3},
                                               RunArchive::open_to_read(archive_)),
                       result.findings.designs, result.findings.variants);
  ASSERT_EQ(errors.size(), 3U);
  EXPECT_EQ(errors[0].runs, 6U);
  EXPECT_NEAR(errors[0].largest_change.value(), 0.0, 1e-12);
  EXPECT_EQ(errors[1].kind, "sensitivity");
  EXPECT_EQ(errors[1].runs, 4U);
  EXPECT_NEAR(errors[2].largest_change.value(), 0.5, 1e-9);
  EXPECT_EQ(RunArchive::open_to_read(archive_).reevaluations().size(), 17U);
}

TEST_F(ReevaluationRun, TheArchiveKeepsWhatWasFound) {
  (void)run(2);
  (void)run(2);
  const std::vector<Reevaluation> rows = RunArchive::open_to_read(archive_).reevaluations();
  ASSERT_EQ(rows.size(), 2U) << "not twice";
  std::map<std::string, Reevaluation> by_design;
  for (const Reevaluation& row : rows) by_design[row.design_hash] = row;
  Phenotype winner;
  winner.body = meshes::Polycube::from_digits(3, 3, 3, bar_3);
  const Reevaluation& found = by_design.at(design_hash(winner, 1));
  EXPECT_EQ(found.variant, "reference");
  EXPECT_EQ(found.duration_s, 0.1);
  ASSERT_TRUE(found.result.displacement_m);
  EXPECT_NEAR((*found.result.displacement_m)[0], 3e-3, 1e-12);
  EXPECT_NE(found.protocol.find("pressure_Pa = [0, 6000]"), std::string::npos) << found.protocol;
}

TEST_F(ReevaluationRun, TheFileOfTheArchiveHoldsEverything) {
  (void)run(2);
  EXPECT_FALSE(fs::exists(archive_.string() + "-wal"));
  fs::copy_file(archive_, folder_ / "copy.sqlite");
  EXPECT_EQ(RunArchive::open_to_read(folder_ / "copy.sqlite").reevaluations().size(), 2U);
}

TEST_F(ReevaluationRun, ALimitedRunDoesNotReplaceWhatIsKnown) {
  (void)run(1);
  fs::remove_all(folder_ / "out");
  walk_as([](const LocomotionJob&, const std::atomic<bool>& stop) { return endless_walk(stop); });
  EXPECT_EQ(run(1, 0, "", "time_limit_s = 0.2\n").status, io::RunStatus::not_converged);
  const std::vector<Reevaluation> rows = RunArchive::open_to_read(archive_).reevaluations();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_TRUE(rows[0].result.displacement_m) << "of the first call";
}

TEST_F(ReevaluationRun, EqualVariantsAndASecondProcessAreRefused) {
  EXPECT_THROW((void)run(1, 0, "[variants]\nyoungs_moduli_Pa = [2e5, 2e5]\n"), io::InputError);
  fs::create_directories(folder_ / "out/runs");
  const io::FileLock lock(folder_ / "out/runs");
  const std::string message = tests::message_of([&] { (void)run(1); });
  EXPECT_NE(message.find("another process"), std::string::npos) << message;
  EXPECT_EQ(calls(), 0U);
}

TEST(Locomotions, EqualJobsAreRunOnceForAll) {
  const tests::TestFolder folder;
  LocomotionJob job{.name = "one", .study = {}};
  job.study.drive.emplace();
  job.study.design = {"bar", meshes::Polycube::from_digits(3, 1, 1, "111"), 0.01};
  LocomotionJob other = job;
  other.study.design.body = meshes::Polycube::from_digits(2, 1, 1, "11");
  const std::vector<LocomotionJob> jobs{job, other, job};
  std::atomic<int> calls{0};
  const Walker walker = [&](const LocomotionJob& one, const fs::path&, const std::atomic<bool>&) {
    ++calls;
    return fake_walk(one);
  };
  for (const bool is_kept : {false, true}) {
    calls = 0;
    const auto runs = run_locomotions(jobs, {.walker = walker, .runs = is_kept ? folder / "runs" : fs::path(), .jobs = 3});
    ASSERT_TRUE(runs);
    EXPECT_EQ(calls, 2);
    EXPECT_EQ((*runs)[0].displacement_m, (*runs)[2].displacement_m);
    EXPECT_TRUE((*runs)[0].displacement_m);
    EXPECT_NE((*runs)[1].displacement_m, (*runs)[0].displacement_m);
    EXPECT_FALSE((*runs)[2].is_repeated);
    EXPECT_EQ((*runs)[0].folder.empty(), !is_kept);
  }
  EXPECT_EQ(run_locomotions(jobs, {.walker = walker, .runs = folder / "runs"})->front().steps, 1000U);
  EXPECT_EQ(calls, 2) << "the files hold the results";
}

TEST(Locomotions, AFolderInWhichAnotherProcessWalksIsLeftToIt) {
  const tests::TestFolder folder;
  LocomotionJob job{.name = "one", .study = {}};
  job.study.drive.emplace();
  job.study.design = {"bar", meshes::Polycube::from_digits(3, 1, 1, "111"), 0.01};
  const std::vector<LocomotionJob> jobs{job};
  int calls = 0;
  const Walker walker = [&](const LocomotionJob& one, const fs::path&, const std::atomic<bool>&) {
    ++calls;
    return fake_walk(one);
  };
  const LocomotionRunOptions options{.walker = walker, .runs = folder / "runs"};
  const fs::path first = run_locomotions(jobs, options)->front().folder.parent_path();
  fs::remove_all(first);
  fs::create_directories(first);
  io::write_whole(first / "locomotion.checkpoint", "of another process");
  calls = 0;
  fs::path second;
  {
    const io::FileLock other(first);
    second = run_locomotions(jobs, options)->front().folder.parent_path();
    EXPECT_EQ(second, first.string() + "_2");
    EXPECT_EQ(calls, 1);
    EXPECT_FALSE(fs::exists(first / "calls.toml")) << "nothing is written beside the other process";
  }
  EXPECT_EQ(run_locomotions(jobs, options)->front().folder.parent_path(), second);
  EXPECT_EQ(calls, 1) << "what is finished is found in any of the folders";
}

TEST_F(ReevaluationRun, StopsAndGoesOn) {
  std::atomic<bool> stop{false};
  options_.stop = &stop;
  options_.progress = [&](std::size_t done, std::size_t, const std::string&) { stop = done >= 2; };
  EXPECT_EQ(run(4).status, io::RunStatus::stopped);
  EXPECT_FALSE(fs::exists(folder_ / "out/reevaluation.csv"));
  EXPECT_TRUE(RunArchive::open_to_read(archive_).reevaluations().empty());
  EXPECT_EQ(calls(), 2U);
  stop = false;
  options_.progress = nullptr;
  EXPECT_EQ(run(4).status, io::RunStatus::completed);
  EXPECT_EQ(calls(), 4U);
}

TEST_F(ReevaluationRun, ARunWhoseTimeIsUpGoesOnUnderALargerLimit) {
  walk_as([this](const LocomotionJob& job, const std::atomic<bool>& stop) {
    return calls() == 1 ? endless_walk(stop) : fake_walk(job);
  });
  const ReevaluationResult limited = run(1, 0, "", "time_limit_s = 0.2\n");
  EXPECT_EQ(limited.status, io::RunStatus::not_converged);
  EXPECT_EQ(table("reevaluation.csv").text(0, "elements_status"), "stopped");
  EXPECT_EQ(table("reevaluation.csv").text(0, "elements_reason"), "time limit of 0.2 s");
  EXPECT_EQ(run(1, 0, "", "time_limit_s = 0.2\n").repeated, 0U);
  EXPECT_EQ(run(1, 0, "", "time_limit_s = 60\n").status, io::RunStatus::completed);
  EXPECT_EQ(calls(), 2U);
}

TEST_F(ReevaluationRun, DamagedResultsAreMadeAgain) {
  (void)run(1);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / "out/runs"))
    if (entry.path().filename() == "locomotion.toml") io::write_whole(entry.path(), "status = ");
  EXPECT_EQ(run(1).repeated, 1U);
  EXPECT_EQ(table("reevaluation.csv").text(0, "elements_status"), "completed");
}

TEST_F(ReevaluationRun, InputThatFiniteElementsRefuseOfEveryDesignIsWrongInput) {
  walk_as([](const LocomotionJob&, const std::atomic<bool>&) -> fem::LocomotionResult {
    throw io::InputError("ground.height_m = 7: too high");
  });
  const std::string message = tests::message_of([&] { (void)run(2); });
  EXPECT_NE(message.find("ground.height_m = 7: too high"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(folder_ / "out/reevaluation.csv"));
}

TEST_F(ReevaluationRun, DesignsThatCannotBeCastAreWrongInput) {
  fs::remove(archive_);
  tests::make_archive(archive_, tests::silicone_study(), {weak});
  const std::string message = tests::message_of([&] { (void)run(1); });
  EXPECT_NE(message.find("no design can be evaluated"), std::string::npos) << message;
  fs::remove(archive_);
  tests::make_archive(archive_, tests::silicone_study(), {});
  EXPECT_NE(tests::message_of([&] { (void)run(1); }).find("no design has a fitness"), std::string::npos);
  EXPECT_EQ(calls(), 0U);
}

TEST_F(ReevaluationRun, AnArchiveInUseIsFoundBeforeAnythingRuns) {
  const io::FileLock lock(archive_);
  EXPECT_THROW((void)run(1), io::InputError);
  EXPECT_EQ(calls(), 0U);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace menger::evolution
