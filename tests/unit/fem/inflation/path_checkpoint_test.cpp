#include "fem/inflation/path_checkpoint.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

class PathCheckpoint : public testing::Test {
 protected:
  [[nodiscard]] std::string refusal(const std::string& identity) const {
    try {
      static_cast<void>(read_checkpoint(file_, identity, MPI_COMM_WORLD));
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  const tests::TestFolder folder_;
  const fs::path file_ = folder_ / "path.checkpoint";
};

PathProgress some_progress() {
  PathPoint point;
  point.s = 0.1 + 0.2;  // not a short decimal
  point.step = 3;
  point.pressures_Pa = {1234.5, -0.0};
  point.plenum_volumes_m3 = {4e-6};
  point.chamber_volumes_m3 = {1e-6, 3e-6};
  point.strain_energy_J = 1.0 / 3.0;
  point.work_J = 0.25;
  point.dead_load_work_J = -0.5;
  point.ground_force_N = 7.0;
  point.smallest_ratio = 0.75;
  point.negative_pivots = 2;
  point.iterations = 5;
  point.seconds = 0.125;
  PathProgress progress;
  progress.restart.s = {0.0, 0.1 + 0.2};
  progress.restart.states = {{{1.0, 2.0, 3.0}, {0.0}, {}}, {{4.0, 5.0, 1e-300}, {6.0}, {7.0, 8.0}}};
  progress.restart.points = {PathPoint{}, point};
  progress.restart.limit_points = {{1, -5.0, 2e-6, false}};
  progress.restart.next_step = 0.7;
  progress.restart.failed_s = 0.9;
  progress.restart.failed_status = io::RunStatus::inverted_element;
  progress.restart.failure = "an element turned inside out";
  progress.restart.rejected_steps = 11;
  progress.observations = {{}, {{{1.0, 2.0, 3.0}, 1.5}}};
  progress.extent_changes_m = {std::nullopt, Point{1e-4, -2e-4, 1.0 / 3.0}};
  return progress;
}

TEST_F(PathCheckpoint, GivesEveryNumberBack) {
  const PathProgress written = some_progress();
  write_checkpoint(file_, "study", written, MPI_COMM_WORLD);
  const auto read = read_checkpoint(file_, "study", MPI_COMM_WORLD);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->restart.s, written.restart.s);
  EXPECT_EQ(read->restart.next_step, written.restart.next_step);
  EXPECT_EQ(read->restart.failed_s, written.restart.failed_s);
  EXPECT_EQ(read->restart.failed_status, written.restart.failed_status);
  EXPECT_EQ(read->restart.failure, written.restart.failure);
  EXPECT_EQ(read->restart.rejected_steps, written.restart.rejected_steps);
  ASSERT_EQ(read->restart.limit_points.size(), 1U);
  EXPECT_EQ(read->restart.limit_points[0].plenum, 1U);
  EXPECT_EQ(read->restart.limit_points[0].volume_m3, 2e-6);
  ASSERT_EQ(read->restart.states.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(read->restart.states[n].displacements_m, written.restart.states[n].displacements_m);
    EXPECT_EQ(read->restart.states[n].plenum_pressures_Pa, written.restart.states[n].plenum_pressures_Pa);
    EXPECT_EQ(read->restart.states[n].element_pressures_Pa, written.restart.states[n].element_pressures_Pa);
  }
  ASSERT_EQ(read->restart.points.size(), 2U);
  const PathPoint& point = read->restart.points[1];
  const PathPoint& expected = written.restart.points[1];
  EXPECT_EQ(point.s, expected.s);
  EXPECT_EQ(point.step, expected.step);
  EXPECT_EQ(point.pressures_Pa, expected.pressures_Pa);
  EXPECT_EQ(point.plenum_volumes_m3, expected.plenum_volumes_m3);
  EXPECT_EQ(point.chamber_volumes_m3, expected.chamber_volumes_m3);
  EXPECT_EQ(point.strain_energy_J, expected.strain_energy_J);
  EXPECT_EQ(point.work_J, expected.work_J);
  EXPECT_EQ(point.dead_load_work_J, expected.dead_load_work_J);
  EXPECT_EQ(point.ground_force_N, expected.ground_force_N);
  EXPECT_EQ(point.smallest_ratio, expected.smallest_ratio);
  EXPECT_EQ(point.negative_pivots, expected.negative_pivots);
  EXPECT_EQ(point.smallest_gap_m, std::nullopt);
  EXPECT_EQ(point.iterations, expected.iterations);
  EXPECT_EQ(point.seconds, expected.seconds);
  EXPECT_EQ(read->observations, written.observations);
  EXPECT_EQ(read->extent_changes_m, written.extent_changes_m);
  EXPECT_FALSE(read->outcome);
}

TEST_F(PathCheckpoint, GivesTheOutcomeOfAnEndedPathBack) {
  PathProgress written = some_progress();
  written.outcome = {io::RunStatus::limit_point, "no \"state\"\nbeyond", {{1, 2e4, 3e-6, true}}, 4};
  write_checkpoint(file_, "study", written, MPI_COMM_WORLD);
  const auto read = read_checkpoint(file_, "study", MPI_COMM_WORLD);
  ASSERT_TRUE(read && read->outcome);
  EXPECT_EQ(read->outcome->status, io::RunStatus::limit_point);
  EXPECT_EQ(read->outcome->reason, written.outcome->reason);
  ASSERT_EQ(read->outcome->limit_points.size(), 1U);
  EXPECT_EQ(read->outcome->limit_points[0].pressure_Pa, 2e4);
  EXPECT_TRUE(read->outcome->limit_points[0].passed);
  EXPECT_EQ(read->outcome->rejected_steps, 4);
}

TEST_F(PathCheckpoint, IsNothingWhereNoneWasWritten) { EXPECT_FALSE(read_checkpoint(file_, "study", MPI_COMM_WORLD)); }

TEST_F(PathCheckpoint, RefusesAnotherStudyNamingTheFile) {
  write_checkpoint(file_, "study", some_progress(), MPI_COMM_WORLD);
  EXPECT_NE(refusal("another").find("another study"), std::string::npos);
  EXPECT_NE(refusal("another").find("path.checkpoint"), std::string::npos);
  EXPECT_NE(refusal("another").find("--restart"), std::string::npos);
}

TEST_F(PathCheckpoint, RefusesEveryDamage) {
  write_checkpoint(file_, "study", some_progress(), MPI_COMM_WORLD);
  const std::string whole = io::read_whole(file_);
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    io::write_whole(file_, whole.substr(0, size));
    EXPECT_NE(refusal("study"), "accepted") << "cut to " << size;
  }
  for (std::size_t place = 0; place < whole.size(); place += 5) {
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ 1);
    io::write_whole(file_, damaged);
    EXPECT_NE(refusal("study"), "accepted") << "bit at " << place;
  }
}

}  // namespace
}  // namespace menger::fem
