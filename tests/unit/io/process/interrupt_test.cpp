#include "io/process/interrupt.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

[[noreturn]] void raise_and_report(int signal) {
  catch_interrupts();
  const bool before = interrupted();
  std::raise(signal);
  std::_Exit(!before && interrupted() ? 0 : 1);
}

TEST(Interrupt, FirstSignalOnlySetsTheFlag) {
  EXPECT_EXIT(raise_and_report(SIGINT), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(raise_and_report(SIGTERM), testing::ExitedWithCode(0), "");
}

TEST(Interrupt, SecondSignalEndsTheProgram) {
  for (const int first : {SIGINT, SIGTERM}) {
    for (const int second : {SIGINT, SIGTERM}) {
      EXPECT_EXIT(
          {
            catch_interrupts();
            std::raise(first);
            std::raise(second);
            std::_Exit(0);
          },
          testing::KilledBySignal(second), "")
          << first << ' ' << second;
    }
  }
}

/// Computes for a while, as a library does that knows nothing of interrupts.
void compute_for(std::chrono::seconds time) {
  volatile unsigned long sum = 0;
  for (const Clock::time_point end = Clock::now() + time; Clock::now() < end;) sum = sum + 1;
}

/// Runs a program that ends with 0 if nothing ends it before, far later than an interrupt should. @return its exit code
int code_of(const std::function<void()>& program) {
  const pid_t child = fork();
  if (child == 0) {
    program();
    std::_Exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

constexpr auto minutes = std::chrono::seconds(120);

TEST(LateStop, ProgramInALongCallLeavesAboutASecondLater) {
  const Clock::time_point start = Clock::now();
  EXPECT_EXIT(
      {
        catch_interrupts();
        std::raise(SIGINT);
        compute_for(minutes);
      },
      testing::ExitedWithCode(130), "stopped in the middle of a computation");
  const auto passed = Clock::now() - start;
  EXPECT_GE(passed, std::chrono::seconds(1)) << "it has a second to stop by itself";
  EXPECT_LT(passed, std::chrono::seconds(60));
}

TEST(LateStop, ProgramThatWaitsForOthersLeavesToo) {
  EXPECT_EXIT(
      {
        catch_interrupts();
        std::raise(SIGTERM);
        std::this_thread::sleep_for(minutes);
      },
      testing::ExitedWithCode(130), "");
}

TEST(LateStop, ProgramThatCameToAStoppingPointIsWaitedFor) {
  EXPECT_EQ(code_of([] {
              catch_interrupts();
              std::raise(SIGINT);
              come_to_stop();
              compute_for(std::chrono::seconds(2));
            }),
            0);
}

TEST(LateStop, StoppingPointBeforeTheInterruptDoesNotCount) {
  EXPECT_EQ(code_of([] {
              catch_interrupts();
              come_to_stop();
              std::raise(SIGINT);
              compute_for(minutes);
            }),
            130);
}

TEST(Interrupt, BeforeAProgramCanAnswerWaitsForIt) {
  EXPECT_EXIT(
      {
        hold_interrupts();
        std::raise(SIGTERM);
        const bool before = interrupted();
        catch_interrupts();
        std::_Exit(!before && interrupted() ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(LateStop, LeavesNoPartOfAFileAndNoLaterOne) {
  const tests::TestFolder folder;
  write_whole(folder / "whole.txt", "before");
  EXPECT_EQ(code_of([&] {
              catch_interrupts();
              PendingFile first(folder / "whole.txt");
              PendingFile second(folder / "new.txt");
              std::ofstream(first.temporary()) << "half";
              std::ofstream(second.temporary()) << "half";
              std::raise(SIGINT);
              compute_for(minutes);
              first.commit();
            }),
            130);
  EXPECT_EQ(read_whole(folder / "whole.txt"), "before");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace menger::io
