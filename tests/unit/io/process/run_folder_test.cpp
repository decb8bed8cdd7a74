#include "io/process/run_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>

#include "io/process/exit_code.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, RemovesWhatAnEarlierRunLeftAndNothingElse) {
  const tests::TestFolder folder;
  fs::create_directories(folder / "frames");
  for (const char* name :
       {"result.csv", "notes.txt", "curve_1.png", "curve_2.png", "curve.png", "frames/frame_1.vtu", "frames/mine.vtu"})
    write_whole(folder / name, "x");
  const RunFolder run("menger-x", folder.path());
  run.remove({"result.csv", "missing.csv", "curve_*.png", "frames/frame_*.vtu", "nowhere/*.vtu"});
  for (const char* name : {"result.csv", "curve_1.png", "curve_2.png", "frames/frame_1.vtu"})
    EXPECT_FALSE(fs::exists(folder / name)) << name;
  for (const char* name : {"notes.txt", "curve.png", "frames/mine.vtu"}) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST(RunFolder, EndsWithAManifest) {
  const tests::TestFolder folder;
  RunFolder("menger-x", folder.path()).finish("a = 1\n", {{"study.toml", "hash"}}, 7);
  const std::string text = read_whole(folder / "manifest.json");
  for (const char* part : {"menger-x", "\"a\": 1", "study.toml", "\"seed\": 7"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(RunFolder, BeginsWithoutTheManifestOfAnEarlierRun) {
  const tests::TestFolder folder;
  const RunFolder run("menger-x", folder.path());
  EXPECT_FALSE(run.is_own());
  run.finish("a = 1\n", {});
  write_whole(folder / "result.csv", "x");
  write_whole(folder / "run.checkpoint", "x");
  EXPECT_TRUE(run.is_own());
  run.begin({"result.csv"});
  EXPECT_FALSE(run.is_own());
  EXPECT_FALSE(fs::exists(folder / "result.csv"));
  EXPECT_TRUE(fs::exists(folder / "run.checkpoint"));
  write_whole(folder / "manifest.json", "no JSON");
  EXPECT_FALSE(run.is_own());
}

TEST(RunFolder, RefusesResultsOfAnotherProgram) {
  const tests::TestFolder folder;
  RunFolder("menger-simulate", folder.path()).finish("a = 1\n", {});
  write_whole(folder / "result.toml", "x");
  try {
    const RunFolder other("menger-inflate", folder.path());
    FAIL() << "begins in the folder of another program";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              folder.path().string() + ": holds results of menger simulate: choose another folder with -o");
  }
  EXPECT_TRUE(fs::exists(folder / "result.toml"));
  EXPECT_TRUE(RunFolder("menger-simulate", folder.path()).is_own()) << "the same program goes on";
  for (const char* text : {"no JSON", "{}"}) {
    write_whole(folder / "manifest.json", text);
    EXPECT_FALSE(RunFolder("menger-inflate", folder.path()).is_own()) << "of nobody: " << text;
  }
}

TEST(RunFolder, CountsTheTimeOfEarlierCalls) {
  RunFolder run("menger-x", "anywhere");
  const double before_s = run.seconds();
  run.add_seconds(100.0);
  EXPECT_GE(run.seconds() - before_s, 100.0);
}

TEST(ExitCode, FollowsFromTheStatus) {
  EXPECT_EQ(exit_code_of(RunStatus::completed), exit_code::done);
  EXPECT_EQ(exit_code_of(RunStatus::diverged), exit_code::numerical);
  EXPECT_EQ(exit_code_of(RunStatus::stopped), exit_code::interrupted);
  const std::array worst_stopped{RunStatus::diverged, RunStatus::stopped};
  EXPECT_EQ(exit_code_of(worst_stopped), exit_code::interrupted);
  const std::array one_diverged{RunStatus::completed, RunStatus::diverged};
  EXPECT_EQ(exit_code_of(one_diverged), exit_code::numerical);
}

}  // namespace
}  // namespace menger::io
