// menger reevaluate under mpirun, of Open MPI.

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "io/text/whole_file.h"
#include "tests/support/archive_content.h"
#include "tests/support/program_run.h"
#include "tests/support/silicone_archive.h"
#include "tests/support/test_folder.h"
#include "tests/support/two_processes.h"
#include "tests/support/wait_until.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::Outcome;
using test_support::ProgramRun;

constexpr const char* program = MENGER_PROGRAM_DIR "/menger-reevaluate";

/// The program on two ranks of mpirun, and what it leaves without.
class ReevaluateOnRanks : public testing::Test {
 protected:
  ReevaluateOnRanks() {
    tests::make_archive(folder_ / "run.sqlite", tests::silicone_study(),
                        {"111100000100000000000000000", "111000000000000000000000000"});
    io::write_whole(folder_ / "study.toml", "[time]\nduration_s = 0.06\nrecord_interval_s = 0.01\nframe_interval_s = 0.02\n");
    fs::copy(folder_ / "run.sqlite", folder_ / "alone.sqlite");
    const Outcome alone =
        ProgramRun(folder_, program, {"alone.sqlite", "--top", "2", "--study", "study.toml", "-o", "alone", "--no-pictures"})
            .wait();
    EXPECT_EQ(alone.code, 0) << alone.err;
  }

  [[nodiscard]] ProgramRun start_ranks() const {
    return test_support::start_two_processes(
        folder_, program, {"run.sqlite", "--top", "2", "--study", "study.toml", "-o", "out", "--no-pictures", "-j", "1"});
  }

  /// Expects the archive and the files of the run without ranks, as far as these have no wall times.
  void expect_as_alone() const {
    EXPECT_EQ(test_support::archive_content(folder_ / "run.sqlite"), test_support::archive_content(folder_ / "alone.sqlite"));
    for (const char* file : {"ranking.csv", "summary.txt", "trajectories/rank_0001.csv", "trajectories/rank_0002.csv",
                             "winner/voxels_0002.vtu", "winner/elements_0002.vtu"}) {
      ASSERT_EQ(fs::exists(folder_ / "out" / file), fs::exists(folder_ / "alone" / file)) << file;
      if (fs::exists(folder_ / "alone" / file)) {
        EXPECT_EQ(io::read_whole(folder_ / "out" / file), io::read_whole(folder_ / "alone" / file)) << file;
      }
    }
  }

  const tests::TestFolder folder_;
};

TEST_F(ReevaluateOnRanks, GivesWhatOneProcessGives) {
  const Outcome outcome = start_ranks().wait();
  ASSERT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  EXPECT_NE(outcome.out.find("\n2 runs of finite elements made"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("each process did from 1 (rank "), std::string::npos) << outcome.out;
  expect_as_alone();
}

TEST_F(ReevaluateOnRanks, GoesOnAfterARankWasKilled) {
  {
    const ProgramRun killed = start_ranks();
    ASSERT_TRUE(test_support::wait_until([&] {
      return killed.name().empty() || (test_support::ranks_of(killed).size() == 2 && fs::exists(folder_ / "out/runs"));
    }));
    ASSERT_GE(test_support::ranks_of(killed).size(), 2U) << "ended before it was killed";
    kill(test_support::ranks_of(killed).at(1), SIGKILL);
    EXPECT_NE(killed.wait().code, 0);
  }
  const Outcome outcome = start_ranks().wait();
  ASSERT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  expect_as_alone();
}

}  // namespace
}  // namespace menger
