#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "io/text/version.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

std::string shell_word(const fs::path& path) { return std::string("'").append(path.string()).append("'"); }

/// A folder that holds a copy of the dispatcher and programs of the test's own making.
class MengerProgram : public testing::Test {
 protected:
  MengerProgram() {
    fs::create_directories(folder_ / "bin");
    fs::copy_file(fs::path(MENGER_PROGRAM_DIR) / "menger", folder_ / "bin/menger");
  }

  void add_program(const std::string& name, const std::string& script) const {
    write_whole(folder_ / "bin" / name, std::string("#!/bin/sh\n").append(script).append("\n"));
    fs::permissions(folder_ / "bin" / name, fs::perms::owner_all);
  }

  [[nodiscard]] Outcome run(const std::string& arguments) const {
    const std::string command = shell_word(folder_ / "bin/menger") + " " + arguments + " >" + shell_word(folder_ / "out") +
                                " 2>" + shell_word(folder_ / "err");
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), read_whole(folder_ / "out"), read_whole(folder_ / "err")};
  }

  const tests::TestFolder folder_;
};

TEST_F(MengerProgram, RunsTheProgramBesideItWithAllArgumentsAndItsExitCode) {
  add_program("menger-evolve", "printf '%s|' \"$@\"; exit 3");
  const Outcome outcome = run("evolve 'a study.toml' --help");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.out, "a study.toml|--help|");
}

TEST_F(MengerProgram, HelpListsOnlyTheProgramsThatExist) {
  add_program("menger-evolve", "");
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("menger evolve study.toml"), std::string::npos);
  EXPECT_EQ(outcome.out.find("simulate scene"), std::string::npos);
}

TEST_F(MengerProgram, HelpHasPurposesInOneColumnBesideTheLongestName) {
  add_program("menger-fit", "");
  add_program("menger-compare-searches", "");
  const Outcome outcome = run("--help");
  EXPECT_NE(outcome.out.find("\n  fit               fit a hyperelastic law"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\n  compare-searches  compare results"), std::string::npos) << outcome.out;
}

TEST_F(MengerProgram, TellsItsVersion) {
  const Outcome outcome = run("--version");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, std::string(version()) + "\n");
}

TEST_F(MengerProgram, RefusesAnUnknownCommandWithTheList) {
  add_program("menger-evolve", "");
  const Outcome outcome = run("evolv study.toml");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.rfind("menger: error: unknown command evolv, did you mean evolve?\n", 0), 0U) << outcome.err;
  EXPECT_NE(outcome.err.find("menger evolve study.toml"), std::string::npos);
}

TEST_F(MengerProgram, RunsNothingOutsideItsFolder) {
  add_program("menger-x", "exit 0");
  fs::create_directories(folder_ / "bin/menger-a");
  EXPECT_EQ(run("a/../menger-x").code, 2);
}

TEST_F(MengerProgram, WithoutACommandSaysHowItIsUsed) {
  const Outcome outcome = run("");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("usage: menger <command>"), std::string::npos);
}

TEST_F(MengerProgram, IsFoundThroughALink) {
  add_program("menger-evolve", "echo ran");
  fs::create_symlink(folder_ / "bin/menger", folder_ / "menger");
  const std::string command = shell_word(folder_ / "menger") + " evolve >" + shell_word(folder_ / "out");
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0);
  EXPECT_EQ(read_whole(folder_ / "out"), "ran\n");
}

}  // namespace
}  // namespace menger::io
