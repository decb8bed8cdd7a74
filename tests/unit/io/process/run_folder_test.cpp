#include "io/process/run_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/process/exit_code.h"
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
  for (const char* part : {"menger-x", "a = 1", "study.toml", "\"seed\": 7"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(ExitCode, FollowsFromTheStatus) {
  EXPECT_EQ(exit_code_of(RunStatus::completed), exit_code::done);
  EXPECT_EQ(exit_code_of(RunStatus::diverged), exit_code::numerical);
  EXPECT_EQ(exit_code_of(RunStatus::stopped), exit_code::interrupted);
}

}  // namespace
}  // namespace menger::io
