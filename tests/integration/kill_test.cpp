#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <optional>
#include <string>

#include "evolution/archive/run_archive.h"
#include "tests/support/archive_content.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::archive_content;
using test_support::Outcome;
using test_support::ProgramRun;

constexpr int last_generation = 4;

class KilledSearch : public testing::TestWithParam<int> {
 protected:
  KilledSearch() {
    const Outcome whole = run("whole.sqlite", 0, 0);
    commits_ = std::stoul(whole.out);
    expected_ = archive_content(folder_ / "whole.sqlite");
  }

  [[nodiscard]] Outcome run(const std::string& archive, std::size_t fatal_commit, std::size_t fatal_evaluation) const {
    const auto text = [](auto number) { return std::to_string(number); };
    return ProgramRun(folder_, MENGER_SEARCH_CHILD, {archive, text(GetParam()), text(fatal_commit), text(fatal_evaluation)})
        .wait();
  }

  /// Returns the last finished generation in the archive that the killed process left.
  [[nodiscard]] std::optional<int> finished_generation(const std::string& archive) const {
    return evolution::RunArchive::open_to_read(folder_ / archive).last_generation();
  }

  const tests::TestFolder folder_;
  std::size_t commits_ = 0;
  std::string expected_;
};

TEST_P(KilledSearch, GoesOnToTheSameArchiveAfterEveryCommit) {
  ASSERT_GT(commits_, 30U);
  for (std::size_t commit = 1; commit < commits_; ++commit) {
    const std::string archive = "after_" + std::to_string(commit) + ".sqlite";
    const Outcome killed = run(archive, commit, 0);
    ASSERT_EQ(killed.signal, SIGKILL) << killed.err;
    ASSERT_LT(finished_generation(archive).value_or(-1), last_generation) << "no work remained";
    const Outcome resumed = run(archive, 0, 0);
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    // Committed evaluations are not repeated: both processes together commit as often as a whole run.
    EXPECT_EQ(std::stoul(resumed.out), commits_ - commit);
    EXPECT_EQ(archive_content(folder_ / archive), expected_) << "after commit " << commit;
  }
}

TEST_P(KilledSearch, LosesOnlyTheEvaluationsUnderWay) {
  const std::size_t threads = static_cast<std::size_t>(GetParam());
  for (std::size_t evaluation = 1; evaluation + 6 < commits_; evaluation += 3) {
    const std::string archive = "in_" + std::to_string(evaluation) + ".sqlite";
    const Outcome killed = run(archive, 0, evaluation);
    ASSERT_EQ(killed.signal, SIGKILL) << killed.err;
    const Outcome resumed = run(archive, 0, 0);
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    // Of the evaluations that began before this one, at most one per other thread was not committed.
    EXPECT_LE(std::stoul(resumed.out), commits_ - (evaluation - 1) + (threads - 1));
    EXPECT_EQ(archive_content(folder_ / archive), expected_) << "in evaluation " << evaluation;
  }
}

TEST_P(KilledSearch, SurvivesBeingKilledAgainAndAgain) {
  Outcome outcome;
  int kills = 0;
  do {
    outcome = run("again.sqlite", 3, 0);
    kills += outcome.signal == SIGKILL ? 1 : 0;
  } while (outcome.signal == SIGKILL);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(kills, static_cast<int>(commits_ / 3));
  EXPECT_EQ(archive_content(folder_ / "again.sqlite"), expected_);
}

INSTANTIATE_TEST_SUITE_P(Threads, KilledSearch, testing::Values(1, 2, 8));

}  // namespace
}  // namespace menger
