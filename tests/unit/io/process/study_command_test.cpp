#include "io/process/study_command.h"

#include <gtest/gtest.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <string>

#include "io/process/program.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

class StudyCommand : public testing::Test {
 protected:
  [[nodiscard]] std::string command_of(const std::string& text, std::string_view program) const {
    write_whole(folder_ / "study.toml", text);
    return command_of_study(folder_ / "study.toml", program);
  }

  const tests::TestFolder folder_;
};

TEST_F(StudyCommand, IsThatOfTheKeys) {
  const std::string inflation = "[design]\nside = 1\n[material]\nlaw = \"yeoh\"\n[path]\npressure_Pa = [0, 1]\n";
  const std::string scene = "[design]\nside = 1\n[materials]\ndensity = 1\n[time]\nduration_s = 1\n";
  EXPECT_EQ(command_of(inflation, "menger-simulate"), "inflate");
  EXPECT_EQ(command_of(inflation, "menger-evolve"), "inflate");
  EXPECT_EQ(command_of(scene, "menger-inflate"), "simulate");
  EXPECT_EQ(command_of("preset = \"paper\"\nseed = 1\n", "menger-simulate"), "evolve");
  EXPECT_EQ(command_of("[[case]]\nname = \"hold\"\n", "menger-validate"), "load-cases");
}

TEST_F(StudyCommand, IsNoneOfOwnUnknownAndSharedKeys) {
  const std::string inflation = "[design]\nside = 1\n[path]\npressure_Pa = [0, 1]\n";
  EXPECT_EQ(command_of(inflation, "menger-inflate"), "");
  EXPECT_EQ(command_of(inflation, "menger-modes"), "");
  EXPECT_EQ(command_of(inflation, "menger-report"), "") << "reads no study";
  EXPECT_EQ(command_of(inflation + "[pathh]\n", "menger-simulate"), "") << "a key of no command";
  EXPECT_EQ(command_of("[design]\n[ground]\n[time]\n[loads]\n", "menger-inflate"), "") << "of simulate or of locomote";
  EXPECT_EQ(command_of("[robot]\nname = \"bar\"\n[drive]\n", "menger-inflate"), "") << "a robot";
  EXPECT_EQ(command_of("[design\n", "menger-simulate"), "") << "no TOML";
  EXPECT_EQ(command_of_study(folder_ / "missing.toml", "menger-simulate"), "");
}

TEST_F(StudyCommand, BeginsTheMessage) {
  const std::string file = (folder_ / "ch.toml").string();
  write_whole(file, "[path]\npressure_Pa = [0, 1]\n");
  testing::internal::CaptureStderr();
  const int code = run_program("menger-simulate", [&]() -> int {
    CLI::App app;
    std::string scene;
    app.add_option("scene", scene);
    const std::array<const char*, 2> arguments{"menger-simulate", file.c_str()};
    static_cast<void>(parse_arguments(app, arguments.size(), arguments.data()));
    throw InputError(scene + ":1: path: unknown key");
  });
  EXPECT_EQ(code, 2);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "menger-simulate: error: " + file + ": looks like a study of menger inflate: menger inflate " + file +
                " runs it. As a study of menger simulate: " + file + ":1: path: unknown key\n");
}

}  // namespace
}  // namespace menger::io
