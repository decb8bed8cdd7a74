#include "io/process/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace menger::io {
namespace {

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
  EXPECT_EXIT(
      {
        catch_interrupts();
        std::raise(SIGINT);
        std::raise(SIGINT);
      },
      testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace menger::io
