#include "io/process/child_reading.h"

#include <gtest/gtest.h>

#include <csignal>
#include <new>
#include <stdexcept>

#include "io/text/input_error.h"
#include "tests/support/input_error_message.h"

namespace menger::io {
namespace {

using tests::message_of;

std::string read(const std::function<std::string()>& in_child) { return read_in_child("folder/a.msh", "Gmsh", in_child); }

std::string message_of_reader_ended_by(int signal) {
  return message_of([&] {
    (void)read([&]() -> std::string {
      (void)std::raise(signal);
      return {};
    });
  });
}

TEST(ChildReading, ReturnsWhatTheChildReads) {
  EXPECT_EQ(read([] { return std::string(); }), "");
  const std::string long_text = std::string(3'000'000, 'a') + std::string(1, '\0') + "b";
  EXPECT_EQ(read([&] { return long_text; }), long_text) << "longer than a pipe";
}

TEST(ChildReading, KeepsTheStateOfThisProcess) {
  int calls = 0;
  (void)read([&] { return std::to_string(++calls); });
  EXPECT_EQ(calls, 0);
}

TEST(ChildReading, PassesErrorsOn) {
  EXPECT_EQ(message_of([] { (void)read([]() -> std::string { throw InputError("a.msh: no mesh"); }); }), "a.msh: no mesh");
  EXPECT_EQ(message_of([] { (void)read([]() -> std::string { throw std::bad_alloc(); }); }),
            "folder/a.msh: is damaged, or does not fit into memory");
  EXPECT_THROW((void)read([]() -> std::string { throw std::logic_error("odd"); }), std::runtime_error);
}

TEST(ChildReading, TurnsTheEndOfALibraryIntoAnErrorOfTheFile) {
  EXPECT_EQ(message_of_reader_ended_by(SIGSEGV),
            "folder/a.msh: is damaged: the library of Gmsh, which reads it, ended with signal 11 (Segmentation fault)");
}

TEST(ChildReading, LeavesInterruptsToThisProcess) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EQ(read([&] {
                (void)std::raise(signal);
                return std::string("whole");
              }),
              "whole")
        << "signals to the process group reach the child, too";
  }
}

TEST(ChildReading, DoesNotBlameTheFileForAReaderThatWasEnded) {
  EXPECT_EQ(message_of_reader_ended_by(SIGKILL),
            "folder/a.msh: cannot be read: its reader was ended by signal 9 (Killed), maybe for want of memory");
}

}  // namespace
}  // namespace menger::io
