// Ranks that share tasks under mpirun, of Open MPI: ranks that are refused, late, slow, told to stop, or die.

#include <gtest/gtest.h>
#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "io/text/whole_file.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"
#include "tests/support/two_processes.h"
#include "tests/support/wait_until.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::Outcome;
using test_support::ProgramRun;
using test_support::wait_until;

using Words = std::vector<std::string>;

/// Time for others to come as far as they can. A test whose program is right passes whatever it is.
void let_others_work() { std::this_thread::sleep_for(std::chrono::milliseconds(700)); }

class Ranks : public testing::Test {
 protected:
  Ranks() { setenv("OMPI_MCA_odls_base_sigkill_timeout", "1", 1); }  // none is left that would need time to end
  ~Ranks() override { unsetenv("OMPI_MCA_odls_base_sigkill_timeout"); }

  /// Starts rank_child with arguments for each rank; its first rank gets the tasks.
  [[nodiscard]] ProgramRun start(std::initializer_list<Words> ranks, const Words& tasks) const {
    Words arguments;
    bool is_first = true;
    for (const Words& rank : ranks) {
      if (!is_first) arguments.emplace_back(":");
      arguments.insert(arguments.end(), {"-n", "1", MENGER_RANK_CHILD});
      arguments.insert(arguments.end(), rank.begin(), rank.end());
      if (is_first) arguments.insert(arguments.end(), tasks.begin(), tasks.end());
      is_first = false;
    }
    return test_support::start_under_mpirun(folder_, std::move(arguments));
  }

  void make(const char* file) const { io::write_whole(folder_ / file, ""); }

  [[nodiscard]] bool comes(const char* file) const {
    return wait_until([&] { return fs::exists(folder_ / file); });
  }

  [[nodiscard]] static bool prints(const ProgramRun& run, const std::string& text) {
    return wait_until([&] { return run.printed().find(text) != std::string::npos; });
  }

  /// Expects that the ranks ended by themselves. Those of which one does not end are ended by MPI_ABORT, ten seconds later.
  static void expect_no_abort(const Outcome& outcome) {
    EXPECT_EQ(outcome.err.find("MPI_ABORT"), std::string::npos) << outcome.err;
  }

  const tests::TestFolder folder_;
};

TEST_F(Ranks, ShareTasks) {
  const Outcome outcome = start({{}, {}, {}}, {"say a", "say b", "say c"}).wait();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* result : {"0: 0 a\n", "1: 1 b\n", "2: 2 c\n", "completed: each process did from 1 (rank 0 on "})
    EXPECT_NE(outcome.out.find(result), std::string::npos) << outcome.out;
  expect_no_abort(outcome);
}

TEST_F(Ranks, EndAtOnceIfOneOfThreeCanDoNothingAndAnotherIsLate) {
  const ProgramRun run = start({{}, {"--error", "no flour"}, {"--late", "go"}}, {"say a"});
  ASSERT_TRUE(wait_until([&] { return test_support::ranks_of(run).size() == 3; }));
  let_others_work();
  make("go");
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("error: rank 1 on "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(": no flour"), std::string::npos) << outcome.err;
  expect_no_abort(outcome);
}

TEST_F(Ranks, EndAtOnceIfOneOfThreeHasOtherFacts) {
  const Outcome outcome = start({{}, {}, {"--facts", "rye"}}, {"say a"}).wait();
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("error: rank 2 on "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(" has another word than rank 0 on "), std::string::npos) << outcome.err;
  expect_no_abort(outcome);
}

TEST_F(Ranks, EndIfOneEndsBeforeItsFirstTask) {
  const Outcome outcome = start({{}, {"--early-fault", "no butter"}}, {"say a"}).wait();
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("rank 1 ended before its first task: no butter"), std::string::npos) << outcome.err;
  expect_no_abort(outcome);
}

TEST_F(Ranks, CountOneThatAnswersTwiceOnce) {
  const ProgramRun run = start({{}, {"--twice"}, {"--late", "go"}}, {"say a", "say b", "say c"});
  ASSERT_TRUE(wait_until([&] { return test_support::ranks_of(run).size() == 3; }));
  let_others_work();
  make("go");
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("completed"), std::string::npos) << outcome.out;
}

TEST_F(Ranks, MayStartLaterThanTheirPatience) {
  const ProgramRun run = start({{"--patience", "0.5"}, {"--patience", "0.5", "--late", "go"}}, {"say a", "say b"});
  ASSERT_TRUE(wait_until([&] { return test_support::ranks_of(run).size() == 2; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  make("go");
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(Ranks, GoOnWithoutOneThatIsToldToStopDuringTheRollCall) {
  const ProgramRun run = start({{}, {"--told-to-stop"}, {"--late", "go"}}, {"say a", "say b", "say c"});
  ASSERT_TRUE(wait_until([&] { return test_support::ranks_of(run).size() == 3; }));
  let_others_work();
  make("go");
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("was told to stop: the others go on without it"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("completed"), std::string::npos) << outcome.out;
  expect_no_abort(outcome);
}

TEST_F(Ranks, GoOnWithoutOneThatThrowsAndSayWhatItThrew) {
  const Outcome outcome = start({{}, {"--fault", "no bread"}}, {"say a", "say b", "say c"}).wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(" has ended (no bread): the others go on without it"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(", on 1 threads"), std::string::npos) << "which it has no longer: " << outcome.out;
  EXPECT_NE(outcome.out.find("completed"), std::string::npos) << outcome.out;
  expect_no_abort(outcome);
}

TEST_F(Ranks, GoOnWithoutOneThatHangsInTheMiddleOfAMessage) {
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);  // as a network, where the sender has its part in it
  const ProgramRun run = start({{"--patience", "0.5"}, {"--halting"}, {}}, {"wait gate", "say b", "say c", "say d"});
  unsetenv("OMPI_MCA_btl_vader_single_copy_mechanism");
  ASSERT_TRUE(prints(run, "has been silent for 0.5 s: the others go on without it"));
  make("gate");
  const Outcome outcome = run.wait();
  EXPECT_EQ(test_support::code_of_job(outcome), 0) << outcome.err;
  EXPECT_NE(outcome.out.find("completed"), std::string::npos) << outcome.out;
}

TEST_F(Ranks, EndWithWhatATaskThrows) {
  const ProgramRun run = start({{}, {}}, {"wait never", "hurt pain"});
  make("pain");
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("error: rank 1 on "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(": it hurts"), std::string::npos) << outcome.err;
  expect_no_abort(outcome);
}

TEST_F(Ranks, TakeNoResultOfARunThatThrewForOneOfTheNext) {
  const ProgramRun run = start({{"--then", "wait gate", "--then", "say b"}, {}}, {"say a", "wait slow"});
  ASSERT_TRUE(prints(run, "thrown: 0 a") && comes("slow.begun") && comes("gate.begun"));
  make("slow");
  EXPECT_TRUE(prints(run, "1: 1 b")) << run.printed();
  make("gate");
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("completed"), std::string::npos) << outcome.out;
}

TEST_F(Ranks, DropAFaultOfATaskThatAnotherHasDone) {
  const ProgramRun run =
      start({{"--patience", "0.5"}, {"--patience", "0.5"}}, {"wait gate", "hurt pain", "wait last_gate", "say last"});
  ASSERT_TRUE(comes("pain.begun"));
  const pid_t rank = test_support::ranks_of(run).at(1);
  kill(rank, SIGSTOP);
  ASSERT_TRUE(prints(run, "has been silent for 0.5 s: the others go on without it"));
  make("gate");
  ASSERT_TRUE(prints(run, "1: 0 pain")) << "the first rank does it as well";
  ASSERT_TRUE(comes("last_gate.begun"));
  make("pain");
  kill(rank, SIGCONT);
  ASSERT_TRUE(prints(run, "3: 1 last")) << "the rank gets tasks again: " << run.printed();
  make("last_gate");
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("answers again"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("completed"), std::string::npos) << outcome.out;
}

/// Ranks of which one is lost while it has a task: all others wait for files, too.
class RanksWithALostOne : public Ranks {
 protected:
  /// Starts ranks that wait for gate_0, task, gate_2 ..., and halts the second one until it is lost.
  [[nodiscard]] ProgramRun start_and_lose(std::initializer_list<Words> ranks, const Words& tasks) {
    ProgramRun run = start(ranks, tasks);
    EXPECT_TRUE(comes("gate_0.begun") && comes("task.begun"));
    rank_ = test_support::ranks_of(run).at(1);
    lose(run, 1);
    return run;
  }

  /// Halts the rank until it has been lost so many times.
  void lose(const ProgramRun& run, int times) const {
    kill(rank_, SIGSTOP);
    EXPECT_TRUE(wait_until([&] { return count(run, "has been silent") == times; })) << run.printed();
  }

  void let_answer(const ProgramRun& run, int times) const {
    kill(rank_, SIGCONT);
    EXPECT_TRUE(wait_until([&] { return count(run, "answers again") == times; })) << run.printed();
  }

 private:
  /// Counts what is said of the second rank. On a busy machine others may be lost for a while, too.
  [[nodiscard]] static int count(const ProgramRun& run, const std::string& text) {
    std::istringstream printed(run.printed());
    int times = 0;
    for (std::string line; std::getline(printed, line);)
      if (line.starts_with("rank 1 on ") && line.find(text) != std::string::npos) ++times;
    return times;
  }

  pid_t rank_ = 0;
};

TEST_F(RanksWithALostOne, LeaveItTheTaskThatNoOtherHasBegunIfItAnswers) {
  const Words patience{"--patience", "1"};
  const ProgramRun run = start_and_lose({patience, patience}, {"wait gate_0", "wait task", "say last"});
  let_answer(run, 1);
  make("gate_0");
  EXPECT_TRUE(prints(run, "2: 0 last")) << "the first rank takes the next task: " << run.printed();
  make("task");
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("1: 1 task"), std::string::npos) << outcome.out;
}

TEST_F(RanksWithALostOne, GiveItsTaskToOneOtherIfItIsLostTwice) {
  const Words patience{"--patience", "1"};
  const ProgramRun run =
      start_and_lose({patience, patience, patience}, {"wait gate_0", "wait task", "wait gate_2", "wait more", "say last"});
  fs::remove(folder_ / "task.begun");
  make("gate_0");
  ASSERT_TRUE(comes("task.begun")) << "the first rank begins it";
  let_answer(run, 1);
  lose(run, 2);
  make("gate_2");
  ASSERT_TRUE(comes("more.begun"));
  make("more");
  EXPECT_TRUE(prints(run, "4: 2 last")) << "the third rank does not begin the same task: " << run.printed();
  let_answer(run, 2);
  make("task");
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("completed"), std::string::npos) << outcome.out;
}

TEST_F(Ranks, GiveWhatOneHasBegunToOthersIfItIsToldToStop) {
  const ProgramRun run = start({{}, {}}, {"wait first", "wait second"});
  ASSERT_TRUE(comes("first.begun") && comes("second.begun"));
  kill(test_support::ranks_of(run).at(1), SIGTERM);
  ASSERT_TRUE(prints(run, "was told to stop: the others go on without it"));
  let_others_work();
  make("first");
  make("second");
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("1: 0 second"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("1: 1 second"), std::string::npos) << "a part of a result counts as one: " << outcome.out;
  expect_no_abort(outcome);
}

TEST_F(Ranks, KeepWhatHasArrivedWhenTheyStop) {
  const Outcome outcome = start({{"--by-hand"}, {"--by-hand"}}, {"say a", "say b", "say c"}).wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("1: by hand"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("stopped"), std::string::npos) << outcome.out;
}

/// Ranks that wait for each other, and lose the first of them.
class RanksWithoutTheFirst : public Ranks {
 protected:
  [[nodiscard]] ProgramRun start_and_wait() const {
    ProgramRun run = start({{"--patience", "0.5"}, {"--patience", "0.5"}}, {"wait first", "wait second"});
    EXPECT_TRUE(comes("first.begun") && comes("second.begun"));
    return run;
  }
};

TEST_F(RanksWithoutTheFirst, EndIfMpirunDiesWithIt) {
  const ProgramRun run = start_and_wait();
  const std::map<int, pid_t> ranks = test_support::ranks_of(run);
  ASSERT_EQ(ranks.size(), 2U);
  run.send(SIGSTOP);  // it sees neither death
  kill(ranks.at(0), SIGKILL);
  run.send(SIGKILL);
  EXPECT_EQ(run.wait().signal, SIGKILL);
  EXPECT_TRUE(test_support::wait_for_end(ranks.at(1)));
}

TEST_F(RanksWithoutTheFirst, EndIfMpirunLetsThemLive) {
  setenv("OMPI_MCA_orte_enable_recovery", "1", 1);  // as mpirun --enable-recovery
  const ProgramRun run = start_and_wait();
  unsetenv("OMPI_MCA_orte_enable_recovery");
  kill(test_support::ranks_of(run).at(0), SIGKILL);
  const Outcome outcome = run.wait();
  EXPECT_NE(outcome.err.find(": rank 0 has given no sign of life for 5 s"), std::string::npos) << outcome.err;
}

TEST_F(RanksWithoutTheFirst, EndIfItHangs) {
  const ProgramRun run = start_and_wait();
  kill(test_support::ranks_of(run).at(0), SIGSTOP);
  const Outcome outcome = run.wait();
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(outcome.err.find("rank_child: rank 1 on "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(": rank 0 has given no sign of life for 5 s"), std::string::npos) << outcome.err;
}

TEST_F(RanksWithoutTheFirst, GoOnIfTheyWereHaltedAsLong) {
  const ProgramRun run = start_and_wait();
  const std::map<int, pid_t> ranks = test_support::ranks_of(run);
  for (const auto& [rank, process] : ranks) kill(process, SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(6500));
  kill(ranks.at(1), SIGCONT);
  let_others_work();
  kill(ranks.at(0), SIGCONT);
  make("first");
  make("second");
  const Outcome outcome = run.wait();
  EXPECT_EQ(test_support::code_of_job(outcome), 0) << outcome.err;
  EXPECT_NE(outcome.out.find("completed"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace menger
