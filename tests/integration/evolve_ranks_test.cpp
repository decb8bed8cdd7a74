// menger evolve under mpirun, of Open MPI: ranks that share evaluations, are killed, hang, or are told to stop.

#include <gtest/gtest.h>
#include <sys/types.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "io/text/whole_file.h"
#include "tests/support/archive_content.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"
#include "tests/support/two_processes.h"
#include "tests/support/wait_until.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::archive_content;
using test_support::Outcome;
using test_support::ProgramRun;
using test_support::wait_until;

constexpr const char* small_study = R"(preset = "paper"
generations = 4
[population]
survivors = 4
mutants = 4
[body]
levels = [1, 2]
[time]
duration_s = 0.2
)";

const fs::path program = fs::path(MENGER_PROGRAM_DIR) / "menger-evolve";

/// A search of a second or two, and the archive that it leaves without MPI.
class EvolveOnRanks : public testing::Test {
 protected:
  EvolveOnRanks() {
    io::write_whole(folder_ / "study.toml", small_study);
    const Outcome alone = ProgramRun(folder_, program, {"study.toml", "-o", "alone.sqlite", "-t", "2"}).wait();
    EXPECT_EQ(alone.code, 0) << alone.err;
    expected_ = archive_content(folder_ / "alone.sqlite");
  }

  [[nodiscard]] ProgramRun start(int ranks, std::vector<std::string> arguments, const std::string& threads = "1") const {
    arguments.insert(arguments.begin(), {"-n", std::to_string(ranks), program.string(), "study.toml", "-t", threads});
    return test_support::start_under_mpirun(folder_, std::move(arguments));
  }

  /// Starts two ranks with the archive run.sqlite and waits until they have finished a generation.
  [[nodiscard]] ProgramRun start_and_wait(std::vector<std::string> arguments = {}) const {
    ProgramRun run = start(2, std::move(arguments));
    EXPECT_TRUE(wait_until([&] { return run.printed().find("\n   1 ") != std::string::npos || run.name().empty(); }));
    return run;
  }

  /// Goes on with run.sqlite without MPI, and expects that it had finished work and ends as if nothing had happened.
  void expect_resumed() const {
    EXPECT_GE(evolution::RunArchive::open_to_read(folder_ / "run.sqlite").last_generation(), 1) << "finished work was lost";
    const Outcome resumed = ProgramRun(folder_, program, {"study.toml", "-o", "run.sqlite", "-t", "2"}).wait();
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(archive_content(folder_ / "run.sqlite"), expected_);
  }

  const tests::TestFolder folder_;
  std::string expected_;
};

TEST_F(EvolveOnRanks, GivesTheSameArchiveForAnyNumberOfRanksAndThreads) {
  for (const auto& [ranks, threads] : {std::pair{2, "1"}, {3, "2"}}) {
    const std::string archive = "ranks_" + std::to_string(ranks) + ".sqlite";
    const Outcome outcome = start(ranks, {"-o", archive}, threads).wait();
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << "ranks other than the first print nothing";
    EXPECT_NE(outcome.out.find("on " + std::to_string(ranks) + " processes with "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("note: each process did from "), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("note: each process did from 0 "), std::string::npos) << outcome.out;
    EXPECT_EQ(archive_content(folder_ / archive), expected_);
    EXPECT_FALSE(fs::exists(folder_ / (archive + "-wal")));
  }
}

TEST_F(EvolveOnRanks, SearchInASteadyStateThatCanBeReplayedWithout) {
  std::string study = small_study;
  study.insert(study.find("survivors"), "selection = \"steady_state\"\n");
  io::write_whole(folder_ / "study.toml", study);
  const ProgramRun killed = start(3, {"-o", "run.sqlite", "-g", "8"});
  ASSERT_TRUE(wait_until([&] { return killed.printed().find("\n   1 ") != std::string::npos || killed.name().empty(); }));
  kill(test_support::ranks_of(killed).at(0), SIGKILL);
  EXPECT_NE(killed.wait().code, 0);
  const ProgramRun told = start(2, {"-o", "run.sqlite", "-g", "8"});
  ASSERT_TRUE(wait_until([&] { return told.printed().find("\n   2 ") != std::string::npos || told.name().empty(); }));
  kill(test_support::ranks_of(told).at(0), SIGTERM);
  const Outcome stopped = told.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_NE(stopped.out.find("Stopped. Robots that ended are kept."), std::string::npos) << stopped.out;
  const Outcome resumed = start(2, {"-o", "run.sqlite", "-g", "8"}).wait();
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(resumed.out.find("note: each process did from 0 "), std::string::npos) << resumed.out;
  const Outcome replayed =
      ProgramRun(folder_, program, {"study.toml", "-o", "again.sqlite", "-t", "2", "-g", "8", "--replay", "run.sqlite"}).wait();
  ASSERT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_EQ(archive_content(folder_ / "again.sqlite"), archive_content(folder_ / "run.sqlite"));
}

TEST_F(EvolveOnRanks, LosesNothingThatIsFinishedWhenARankDies) {
  const ProgramRun run = start_and_wait();
  kill(test_support::ranks_of(run).at(1), SIGKILL);
  EXPECT_NE(run.wait().code, 0) << "mpirun ends a job of which a rank dies";
  EXPECT_FALSE(fs::exists(folder_ / "run.sqlite-wal")) << "the first rank has closed the archive";
  expect_resumed();
}

TEST_F(EvolveOnRanks, GoesOnWithoutARankThatDiesIfMpirunLetsTheOthersLive) {
  setenv("OMPI_MCA_orte_enable_recovery", "1", 1);  // as mpirun --enable-recovery
  const ProgramRun run = start_and_wait({"--rank-patience", "0.5"});
  unsetenv("OMPI_MCA_orte_enable_recovery");
  kill(test_support::ranks_of(run).at(1), SIGKILL);
  const Outcome outcome = run.wait();
  EXPECT_EQ(test_support::code_of_job(outcome), 0) << outcome.err;
  EXPECT_NE(outcome.out.find("has been silent for 0.5 s: the others go on without it"), std::string::npos) << outcome.out;
  EXPECT_EQ(archive_content(folder_ / "run.sqlite"), expected_);
}

TEST_F(EvolveOnRanks, GoesOnWithoutARankThatHangs) {
  const ProgramRun run = start_and_wait({"--rank-patience", "0.5"});
  kill(test_support::ranks_of(run).at(1), SIGSTOP);
  const Outcome outcome = run.wait();
  EXPECT_EQ(test_support::code_of_job(outcome), 0) << outcome.err;
  EXPECT_NE(outcome.out.find("has been silent for 0.5 s: the others go on without it"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("Champion: "), std::string::npos) << outcome.out;
  EXPECT_EQ(archive_content(folder_ / "run.sqlite"), expected_);
}

TEST_F(EvolveOnRanks, GoesOnWithoutARankThatIsToldToStop) {
  const ProgramRun run = start_and_wait();
  kill(test_support::ranks_of(run).at(1), SIGTERM);
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("was told to stop: the others go on without it"), std::string::npos) << outcome.out;
  EXPECT_EQ(archive_content(folder_ / "run.sqlite"), expected_);
}

TEST_F(EvolveOnRanks, StopsWithItsFirstRank) {
  const ProgramRun run = start_and_wait();
  kill(test_support::ranks_of(run).at(0), SIGTERM);
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_NE(outcome.out.find("Run the same command again to resume."), std::string::npos) << outcome.out;
  EXPECT_FALSE(fs::exists(folder_ / "run.sqlite-wal"));
  expect_resumed();
}

TEST_F(EvolveOnRanks, StopsWithCtrlCToMpirun) {
  const ProgramRun run = start_and_wait();
  run.send(SIGINT);
  const Outcome outcome = run.wait();
  EXPECT_NE(outcome.code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "run.sqlite-wal"));
  expect_resumed();
}

TEST_F(EvolveOnRanks, ResumesAfterAllWereKilled) {
  const ProgramRun run = start_and_wait();
  const std::map<int, pid_t> ranks = test_support::ranks_of(run);
  ASSERT_EQ(ranks.size(), 2U);
  run.send(SIGKILL);
  for (const auto& [rank, process] : ranks) kill(process, SIGKILL);
  EXPECT_EQ(run.wait().signal, SIGKILL);
  for (const auto& [rank, process] : ranks) EXPECT_TRUE(test_support::wait_for_end(process));
  expect_resumed();
}

TEST_F(EvolveOnRanks, EndWithTheirMpirun) {
  const ProgramRun run = start_and_wait();
  const std::map<int, pid_t> ranks = test_support::ranks_of(run);
  ASSERT_EQ(ranks.size(), 2U);
  run.send(SIGKILL);
  EXPECT_EQ(run.wait().signal, SIGKILL);
  for (const auto& [rank, process] : ranks) EXPECT_TRUE(test_support::wait_for_end(process));
  expect_resumed();
}

TEST_F(EvolveOnRanks, ResumeOneRunWithAnyNumberOfRanks) {
  const ProgramRun run = start_and_wait();
  kill(test_support::ranks_of(run).at(0), SIGTERM);
  ASSERT_EQ(run.wait().code, 130);
  const Outcome resumed = start(3, {}).wait();
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.out.find("resuming run.sqlite"), std::string::npos) << resumed.out;
  EXPECT_EQ(archive_content(folder_ / "run.sqlite"), expected_);
}

/// Ranks that cannot begin.
class RefusedRanks : public testing::Test {
 protected:
  RefusedRanks() {
    setenv("OMPI_MCA_odls_base_sigkill_timeout", "1", 1);  // none is left that would need time to end
    io::write_whole(folder_ / "study.toml", small_study);
  }
  ~RefusedRanks() override { unsetenv("OMPI_MCA_odls_base_sigkill_timeout"); }

  const tests::TestFolder folder_;
};

TEST_F(RefusedRanks, SayOnceWhatIsWrongWithTheStudy) {
  io::write_whole(folder_ / "study.toml", std::string("generation = 3\n") + small_study);
  const Outcome outcome = test_support::start_two_processes(folder_, program, {"study.toml"}).wait();
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  const std::size_t first = outcome.err.find("menger-evolve: error: study.toml");
  ASSERT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("menger-evolve: error: ", first + 1), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "run.sqlite"));
}

TEST_F(RefusedRanks, MustHaveTheSameStudy) {
  io::write_whole(folder_ / "other.toml", std::string("seed = 2\n") + small_study);
  const std::string evolve = program;
  const Outcome outcome =
      test_support::start_under_mpirun(folder_, {"-n", "1", evolve, "study.toml", ":", "-n", "1", evolve, "other.toml"}).wait();
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("has another study than rank 0 on "), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "run.sqlite"));
}

TEST_F(RefusedRanks, AreNamedIfTheyHaveNoStudy) {
  const std::string evolve = program;
  const Outcome outcome = test_support::start_under_mpirun(folder_, {"-n", "1", evolve, "study.toml", ":", "-n", "1", evolve,
                                                                     "none.toml", ":", "-n", "1", evolve, "study.toml"})
                              .wait();
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("error: rank 1 on "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(": none.toml: "), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("MPI_ABORT"), std::string::npos) << "the first rank waits for none: " << outcome.err;
}

TEST_F(RefusedRanks, AreNamedIfTheirArgumentsAreWrong) {
  const std::string evolve = program;
  const Outcome outcome = test_support::start_under_mpirun(
                              folder_, {"-n", "1", evolve, "study.toml", ":", "-n", "1", evolve, "study.toml", "--thread", "2"})
                              .wait();
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("error: rank 1 ended before its first task: "), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "run.sqlite"));
}

TEST_F(RefusedRanks, OfSrunMustKnowOfEachOther) {
  const std::string evolve = program;
  const Outcome outcome = ProgramRun(folder_, "/usr/bin/env", {"SLURM_STEP_NUM_TASKS=4", evolve, "study.toml"}).wait();
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("srun started 4 processes that do not know of each other: use srun --mpi=pmix"), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "run.sqlite"));
}

TEST_F(RefusedRanks, AreNoneInABatchScript) {
  const Outcome outcome =
      ProgramRun(folder_, "/usr/bin/env", {"SLURM_NTASKS=16", "SLURM_PROCID=0", program, "study.toml", "-g", "0", "-t", "1"})
          .wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("on 1 thread\n"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace menger
