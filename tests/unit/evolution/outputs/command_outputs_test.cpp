#include "evolution/outputs/command_outputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "io/text/manifest.h"
#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> notes;
  std::vector<std::string> names;
  for (const CommandOutput& output : find_command_outputs(folder, notes)) names.push_back(output.name);
  return names;
}

io::Manifest manifest_of(const std::string& program, const std::string& parameters = "") {
  return {.program = program, .parameters = parameters, .seed = std::nullopt, .inputs = {}};
}

TEST(CommandOutputs, AreFoundByTheirManifests) {
  const tests::TestFolder folder;
  io::write_manifest(folder, manifest_of("menger-export"));
  io::write_manifest(folder / "b/inflate", manifest_of("menger-inflate"));
  io::write_manifest_file(folder / "a/run.manifest.json", manifest_of("menger-evolve"));
  io::write_manifest_file(folder / "mesh_manifest.json", manifest_of("menger-mesh"));
  EXPECT_EQ(names_in(folder), (std::vector<std::string>{"", "a/run.manifest.json", "b/inflate", "mesh_manifest.json"}));
}

TEST(CommandOutputs, AreNotTheInnerRunsOfACommandNorLinks) {
  const tests::TestFolder folder;
  io::write_manifest(folder / "reevaluate", manifest_of("menger-reevaluate"));
  io::write_manifest(folder / "reevaluate/runs/0123456789abcdef/result", manifest_of("menger-locomote"));
  io::write_manifest(folder / "tradeoff/runs/search-0123456789abcdef/0", manifest_of("menger-evolve"));
  io::write_manifest(folder / ".hidden", manifest_of("menger-locomote"));
  fs::create_directory_symlink(folder.path(), folder / "again");
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"reevaluate"});
}

TEST(CommandOutputs, AreThoseInAFolderThatAUserCalledRuns) {
  const tests::TestFolder folder;
  io::write_manifest(folder / "runs/softer", manifest_of("menger-locomote"));
  io::write_manifest(folder / "fields/cube", manifest_of("menger-inflate"));
  EXPECT_EQ(names_in(folder), (std::vector<std::string>{"fields/cube", "runs/softer"}));
}

TEST(CommandOutputs, KnowWhereTheirFilesAre) {
  const tests::TestFolder folder;
  io::write_manifest(folder, manifest_of("menger-export"));
  io::write_manifest_file(folder / "a/run.manifest.json", manifest_of("menger-evolve"));
  std::vector<std::string> notes;
  const std::vector<CommandOutput> outputs = find_command_outputs(folder, notes);
  ASSERT_EQ(outputs.size(), 2U);
  EXPECT_EQ(file_of(outputs[0], "champion.png"), "champion.png");
  EXPECT_EQ(file_of(outputs[1], "champion.png"), "a/champion.png");
}

TEST(CommandOutputs, LeaveOutWhatIsNoManifestWithANote) {
  const tests::TestFolder folder;
  io::write_whole(folder / "a/manifest.json", "{\"program\": 3}");
  io::write_whole(folder / "b/manifest.json", "{\"program\": \"menger-");
  io::write_whole(folder / "c/manifest.json", std::string(100000, '['));
  std::vector<std::string> notes;
  EXPECT_TRUE(find_command_outputs(folder, notes).empty());
  EXPECT_EQ(notes.size(), 3U);
}

TEST(CommandOutputs, RefuseAFolderThatIsNone) {
  const tests::TestFolder folder;
  std::vector<std::string> notes;
  EXPECT_NE(tests::message_of([&] { find_command_outputs(folder / "missing", notes); }).find("missing: is no folder"),
            std::string::npos);
}

TEST(CommandOutputs, HaveBodyAndDriveOfTheirParameters) {
  const tests::TestFolder folder;
  const std::string design = "[design]\nname = \"hook\"\ncell_edge_m = 0.01\nlayers = [[\"11\"], [\"10\"]]\nlevel = 1\n";
  io::write_manifest(
      folder / "a",
      manifest_of("menger-locomote", design + "chambers = \"single\"\n[drive]\nmode = \"in_phase\"\nfrequency_Hz = 3\n"));
  io::write_manifest(folder / "b", manifest_of("menger-simulate",
                                               design + "[drive]\nmode = \"antiphase\"\nfrequency_Hz = 3\n[surrogate]\nx = 1\n"));
  std::vector<std::string> notes;
  const std::vector<CommandOutput> outputs = find_command_outputs(folder, notes);
  ASSERT_EQ(outputs.size(), 2U);
  EXPECT_EQ(outputs[0].body_name, "hook");
  ASSERT_TRUE(outputs[0].stated.body);
  EXPECT_EQ(outputs[0].stated.body, outputs[1].stated.body);
  EXPECT_NE(outputs[0].stated.drive, outputs[1].stated.drive);
  EXPECT_TRUE(outputs[0].is_in_phase);
  EXPECT_FALSE(outputs[1].is_in_phase);
  EXPECT_TRUE(outputs[1].is_calibrated);
}

}  // namespace
}  // namespace menger::evolution
