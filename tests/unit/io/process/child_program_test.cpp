#include "io/process/child_program.h"

#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <utility>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

/// A folder with a shell script to run in it.
class ChildProgramTest : public testing::Test {
 protected:
  [[nodiscard]] ChildProgram script(const std::string& lines) const {
    write_whole(folder_ / "script", "#!/bin/sh\n" + lines + "\n");
    fs::permissions(folder_ / "script", fs::perms::owner_all);
    return {.program = folder_ / "script", .folder = folder_, .out = folder_ / "out", .err = folder_ / "err"};
  }

  const tests::TestFolder folder_;
};

TEST_F(ChildProgramTest, GivesExitCodeOutputAndFolder) {
  ChildProgram child = script("printf '%s|' \"$@\"; pwd; echo wrong >&2; cat; exit 3");
  child.arguments = {"a b", "", "--c"};
  const ChildOutcome outcome = run_child(child);
  EXPECT_EQ(outcome.end, ChildEnd::exited);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.signal, 0);
  EXPECT_EQ(read_whole(folder_ / "out"), "a b||--c|" + fs::canonical(folder_).string() + "\n");
  EXPECT_EQ(read_whole(folder_ / "err"), "wrong\n");
}

TEST_F(ChildProgramTest, PutsBothStreamsIntoOneFileInTheirOrder) {
  ChildProgram child = script("echo 1; echo 2 >&2; echo 3");
  child.err = child.out;
  EXPECT_EQ(run_child(child).exit_code, 0);
  EXPECT_EQ(read_whole(folder_ / "out"), "1\n2\n3\n");
}

TEST_F(ChildProgramTest, CountsProcessorTimeAndMemoryOfTheChild) {
  // dd holds one block of 200 MB, which no other part of this test does
  const ChildOutcome outcome = run_child(script("dd if=/dev/zero of=/dev/null bs=200000000 count=1"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_GT(outcome.peak_memory_bytes, 190'000'000U);
  EXPECT_GT(outcome.cpu_s, 0.0);
  EXPECT_GT(outcome.wall_s, 0.0);
  EXPECT_LT(outcome.cpu_s, 100.0 * outcome.wall_s);
}

TEST_F(ChildProgramTest, EndsAChildThatExceedsItsTime) {
  ChildProgram child = script("trap 'exit 130' INT; while :; do sleep 0.05; done");
  child.time_limit_s = 0.5;  // within which the shell has set its trap on a busy machine, too
  const ChildOutcome outcome = run_child(child);
  EXPECT_EQ(outcome.end, ChildEnd::timed_out);
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_GE(outcome.wall_s, 0.5);
}

TEST_F(ChildProgramTest, AResultThatComesJustAtTheTimeLimitCounts) {
  for (const auto& [code, end] : {std::pair{0, ChildEnd::exited}, {3, ChildEnd::exited}, {2, ChildEnd::timed_out}}) {
    ChildProgram child = script("trap 'exit " + std::to_string(code) + "' INT; while :; do sleep 0.05; done");
    child.time_limit_s = 0.5;
    const ChildOutcome outcome = run_child(child);
    EXPECT_EQ(outcome.end, end) << code;
    EXPECT_EQ(outcome.exit_code, code);
    EXPECT_EQ(outcome.signal, 0);
  }
}

TEST_F(ChildProgramTest, KillsAChildThatDoesNotListen) {
  ChildProgram child = script("trap '' INT; while :; do sleep 0.05; done");
  child.time_limit_s = 0.5;
  child.patience_s = 0.2;
  const ChildOutcome outcome = run_child(child);
  EXPECT_EQ(outcome.end, ChildEnd::timed_out);
  EXPECT_EQ(outcome.exit_code, -1);
  EXPECT_EQ(outcome.signal, SIGKILL);
}

TEST_F(ChildProgramTest, PassesARequestToStopOn) {
  ChildProgram child = script("trap 'echo stopped; exit 130' INT; touch ready; while :; do sleep 0.05; done");
  std::atomic<bool> stop{false};
  child.stop = &stop;
  child.waiting = [&](double) { stop = fs::exists(folder_ / "ready"); };
  const ChildOutcome outcome = run_child(child);
  EXPECT_EQ(outcome.end, ChildEnd::stopped);
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_EQ(read_whole(folder_ / "out"), "stopped\n");
}

TEST_F(ChildProgramTest, TellsASignalFromAnExit) {
  const ChildOutcome outcome = run_child(script("kill -SEGV $$"));
  EXPECT_EQ(outcome.end, ChildEnd::signalled);
  EXPECT_EQ(outcome.signal, SIGSEGV);
  EXPECT_EQ(outcome.exit_code, -1);
}

TEST_F(ChildProgramTest, SaysWhatCannotBeStarted) {
  ChildProgram child = script("");
  child.program = folder_ / "missing";
  EXPECT_THROW(run_child(child), InputError);
  child = script("");
  child.folder = folder_ / "no folder";
  EXPECT_THROW(run_child(child), InputError);
  child = script("");
  child.out = folder_ / "no folder/out";
  EXPECT_THROW(run_child(child), InputError);
  EXPECT_THROW(program_in(folder_, "missing"), InputError);
}

}  // namespace
}  // namespace menger::io
