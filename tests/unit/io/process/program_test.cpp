#include "io/process/program.h"

#include <gtest/gtest.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <new>
#include <stdexcept>

#include "io/process/exit_code.h"
#include "io/process/study_help.h"
#include "io/text/input_error.h"
#include "io/text/version.h"
#include "tests/support/input_error_message.h"

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

}  // namespace
}  // namespace menger::io
