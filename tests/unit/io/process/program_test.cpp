#include "io/process/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <new>
#include <stdexcept>

#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/study_help.h"
#include "io/text/input_error.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

struct Outcome {
  int code = -1;
  std::string message;
};

Outcome outcome_of(const std::function<int()>& body) {
  testing::internal::CaptureStderr();
  const int code = run_program("menger-x", body);
  return {code, testing::internal::GetCapturedStderr()};
}

TEST(Program, ReturnsTheCodeOfItsBody) {
  const Outcome outcome = outcome_of([] { return exit_code::numerical; });
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.message, "");
}

TEST(Program, LeavesWithTwoOnBadInput) {
  const Outcome outcome = outcome_of([]() -> int { throw InputError("a.toml:1: k = 3: must be < 2"); });
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.message, "menger-x: error: a.toml:1: k = 3: must be < 2\n");
}

TEST(Program, LeavesWithTwoWhenMemoryRunsOut) {
  const Outcome outcome = outcome_of([]() -> int { throw std::bad_alloc(); });
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.message, "menger-x: error: not enough memory for this input\n");
}

TEST(Program, LeavesWithOneOnItsOwnFault) {
  const Outcome outcome = outcome_of([]() -> int { throw std::logic_error("odd"); });
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.message, "menger-x: internal error: odd\n");
}

TEST(Program, LeavesWithOneHundredThirtyThoughItWasDoneAfterAnInterrupt) {
  const auto interrupted_one = [](int code) {
    std::_Exit(run_program("menger-x", [&] {
      std::raise(SIGINT);
      return code;
    }));
  };
  EXPECT_EXIT(interrupted_one(exit_code::done), testing::ExitedWithCode(130), "");
  EXPECT_EXIT(interrupted_one(exit_code::numerical), testing::ExitedWithCode(130), "");
  EXPECT_EXIT(interrupted_one(exit_code::bad_input), testing::ExitedWithCode(2), "");
}

TEST(Program, AnswersAnInterruptThatCameWhileItsLibrariesWereLoaded) {
  EXPECT_EXIT(
      {
        hold_interrupts();
        std::raise(SIGINT);
        std::_Exit(run_program("menger-x", [] { return exit_code::done; }));
      },
      testing::ExitedWithCode(130), "");
}

/// Runs a program that prints a line to a descriptor, and ends the process with its exit code.
[[noreturn]] void print_to(int descriptor) {
  ::dup2(descriptor, STDOUT_FILENO);
  std::_Exit(run_program("menger-x", [] {
    std::cout << "a result" << std::endl;
    return exit_code::done;
  }));
}

TEST(Program, SaysThatItsOutputWasLostOnAFullDisk) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): POSIX
  EXPECT_EXIT(print_to(::open("/dev/full", O_WRONLY)), testing::ExitedWithCode(2),
              "menger-x: error: standard output: cannot be written: No space left on device");
}

TEST(Program, GoesOnIfTheReaderOfItsOutputHasGone) {
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  ::close(pipe[0]);
  EXPECT_EXIT(print_to(pipe[1]), testing::ExitedWithCode(0), "^$");
  ::close(pipe[1]);
}

TEST(Program, WritesNoPrintedTextIntoAResultIfItsOutputIsClosed) {
  const tests::TestFolder folder;
  EXPECT_EXIT(
      {
        ::close(STDOUT_FILENO);
        std::_Exit(run_program("menger-x", [&] {
          std::ofstream result(folder / "result.txt");
          result << "a result" << std::flush;
          std::cout << "printed" << std::endl;
          return exit_code::done;
        }));
      },
      testing::ExitedWithCode(0), "");
  EXPECT_EQ(read_whole(folder / "result.txt"), "a result");
}

TEST(Program, NamesTheFileThatMayNotGrow) {
  const tests::TestFolder folder;
  const auto write_much = [&] {
    const rlimit small{.rlim_cur = 1000, .rlim_max = 1000};
    setrlimit(RLIMIT_FSIZE, &small);
    std::_Exit(run_program("menger-x", [&] {
      write_whole(folder / "large.csv", std::string(10'000, 'x'));
      return exit_code::done;
    }));
  };
  EXPECT_EXIT(write_much(), testing::ExitedWithCode(2), "large.csv: cannot be written: File too large");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Program, WritesNothingThatATerminalObeys) {
  testing::internal::CaptureStdout();
  const Outcome outcome = outcome_of([]() -> int {
    std::cout << "silicone \x1b[2J\n"
              << "\xC3" << std::flush << "\xA4\n"
              << 'a' << 1.5 << '\r' << std::endl;
    throw std::runtime_error("x\x1b[1m");
  });
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "silicone \\u001B[2J\n\xC3\xA4\na1.5\\u000D\n");
  EXPECT_EQ(outcome.message, "menger-x: internal error: x\\u001B[1m\n");
}

class Arguments : public testing::Test {
 protected:
  Arguments() { app_.add_option("file", file_)->required(); }

  template <std::size_t count>
  std::optional<int> parse(const std::array<const char*, count>& words) {
    testing::internal::CaptureStdout();
    try {
      const std::optional<int> code = parse_arguments(app_, static_cast<int>(count), words.data());
      printed_ = testing::internal::GetCapturedStdout();
      return code;
    } catch (...) {
      testing::internal::GetCapturedStdout();
      throw;
    }
  }

  CLI::App app_{"what it does", "menger-x"};
  std::string file_;
  std::string printed_;
};

TEST_F(Arguments, ThatFitLetTheProgramGoOn) {
  EXPECT_EQ(parse(std::array{"menger-x", "a.toml"}), std::nullopt);
  EXPECT_EQ(file_, "a.toml");
}

TEST_F(Arguments, AskingForHelpOrVersionEndTheProgram) {
  EXPECT_EQ(parse(std::array{"menger-x", "--help"}), exit_code::done);
  EXPECT_NE(printed_.find("what it does"), std::string::npos);
  EXPECT_EQ(parse(std::array{"menger-x", "--version"}), exit_code::done);
  EXPECT_EQ(printed_, std::string(version()) + "\n");
}

TEST_F(Arguments, ThatDoNotFitAreBadInput) {
  EXPECT_THROW(parse(std::array{"menger-x"}), InputError);
  EXPECT_THROW(parse(std::array{"menger-x", "a.toml", "--unknown"}), InputError);
}

TEST_F(Arguments, AreAskedForWhenMistyped) {
  app_.add_option("--refine", file_);
  const auto message = [&](const char* option) {
    return tests::message_of([&] { (void)parse(std::array{"menger-x", "a.toml", option}); });
  };
  EXPECT_NE(message("--refin=2").find(", did you mean --refine? (see --help)"), std::string::npos) << message("--refin=2");
  EXPECT_EQ(message("--colour").find("did you mean"), std::string::npos) << message("--colour");
}

// A program that reads a study tells about it before it asks for one.
TEST_F(Arguments, AskingForTheKeysOfAStudyEndTheProgram) {
  add_study_help(app_, [](StudyVisitor& visitor) {
    double duration_s = 2.0;
    visitor.number({"duration_s", "How long."}, duration_s, positive());
  });
  EXPECT_EQ(parse(std::array{"menger-x", "--template"}), exit_code::done);
  EXPECT_NE(printed_.find("# How long. (s; > 0)\nduration_s = 2\n"), std::string::npos) << printed_;
  EXPECT_EQ(parse(std::array{"menger-x", "--schema"}), exit_code::done);
  EXPECT_NE(printed_.find("\"exclusiveMinimum\": 0.0"), std::string::npos) << printed_;
  EXPECT_EQ(parse(std::array{"menger-x", "--keys"}), exit_code::done);
  EXPECT_NE(printed_.find("duration_s  number  s     2        > 0     How long.\n"), std::string::npos) << printed_;
}

TEST_F(Arguments, AreNamedWhenMemoryRunsOut) {
  EXPECT_FALSE(parse(std::array{"menger-x", "large.toml"}));
  EXPECT_EQ(outcome_of([]() -> int { throw std::bad_alloc(); }).message, "menger-x: error: not enough memory for large.toml\n");
}

}  // namespace
}  // namespace menger::io
