#include "io/text/manifest.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

TEST(Manifest, HoldsWhatMadeTheResults) {
  const tests::TestFolder folder;
  write_whole(folder / "scene.toml", "a = 1\n");
  Manifest manifest{.program = "menger-simulate",
                    .parameters = "a = 1\nb = \"x\"\n",
                    .seed = 18446744073709551615U,
                    .seconds = 1.5,
                    .inputs = {}};
  note_input(manifest.inputs, folder / "scene.toml");
  write_manifest(folder, manifest);
  const auto json = nlohmann::json::parse(read_whole(folder / "manifest.json"));
  EXPECT_EQ(json.at("program"), "menger-simulate");
  EXPECT_EQ(json.at("version"), std::string(version()));
  EXPECT_EQ(json.at("parameters"), (nlohmann::json{{"a", 1}, {"b", "x"}}));
  EXPECT_EQ(json.at("seed").get<std::uint64_t>(), 18446744073709551615U);
  EXPECT_EQ(json.at("seconds"), 1.5);
  EXPECT_EQ(json.at("inputs_sha256").at((folder / "scene.toml").string()), content_hash("a = 1\n"));
}

TEST(Manifest, LeavesOutASeedThatDoesNotExist) { EXPECT_FALSE(nlohmann::json::parse(manifest_text({})).contains("seed")); }

TEST(Manifest, HoldsNotesIfThereAreAny) {
  EXPECT_FALSE(nlohmann::json::parse(manifest_text({})).contains("notes"));
  Manifest manifest;
  manifest.notes = {"first", "second"};
  const auto json = nlohmann::json::parse(manifest_text(manifest));
  EXPECT_EQ(json.at("notes"), (nlohmann::json{"first", "second"}));
}

TEST(Manifest, SurvivesBytesThatAreNoUtf8) {
  const Manifest manifest{.program = "p", .parameters = "\xff", .seed = {}, .seconds = 0.0, .inputs = {}};
  const std::string text = manifest_text(manifest);
  ASSERT_TRUE(nlohmann::json::accept(text));
  EXPECT_TRUE(nlohmann::json::parse(text).at("parameters").is_string());
}

TEST(Manifest, TellsTheTimeOfAProgramToItAlone) {
  const tests::TestFolder folder;
  const fs::path file = folder / "run.manifest.json";
  EXPECT_EQ(seconds_of_manifest(file, "menger-x"), 0.0);
  write_manifest_file(file, {.program = "menger-x", .parameters = "", .seed = {}, .seconds = 36000.5, .inputs = {}});
  EXPECT_EQ(seconds_of_manifest(file, "menger-x"), 36000.5);
  EXPECT_EQ(seconds_of_manifest(file, "menger-y"), 0.0);
  for (const char* text : {"no JSON", "[1]", "{}", R"({"program": "menger-x"})", R"({"program": "menger-x", "seconds": "1"})"}) {
    write_whole(file, text);
    EXPECT_EQ(seconds_of_manifest(file, "menger-x"), 0.0) << text;
  }
}

TEST(Manifest, HashOfResultsLeavesOutTimeAndPaths) {
  const tests::TestFolder folder;
  const auto hash = [&](const Manifest& manifest) {
    write_manifest(folder, manifest);
    return hash_of_results(folder / "manifest.json");
  };
  const Manifest manifest{
      .program = "p", .parameters = "a = 1\n", .seed = 1, .seconds = 1.5, .inputs = {{"a.toml", "11"}, {"b.toml", "22"}}};
  const std::string whole = hash(manifest);
  Manifest other = manifest;
  other.seconds = 2.5;
  other.inputs = {{"away/a.toml", "22"}, {"away/b.toml", "11"}};
  EXPECT_EQ(hash(other), whole);
  other.inputs["away/b.toml"] = "12";
  EXPECT_NE(hash(other), whole);
  other = manifest;
  other.parameters = "a = 2\n";
  EXPECT_NE(hash(other), whole);
  other = manifest;
  other.seed = 2;
  EXPECT_NE(hash(other), whole);
  other = manifest;
  other.program = "q";
  EXPECT_NE(hash(other), whole);
  EXPECT_EQ(hash_of_results(folder / "absent.json"), "");
  write_whole(folder / "manifest.json", "[no object");
  EXPECT_EQ(hash_of_results(folder / "manifest.json"), content_hash("[no object"));
}

TEST(Version, IsThreeNumbers) {
  int major = 0;
  int minor = 0;
  int patch = 0;
  EXPECT_EQ(std::sscanf(std::string(version()).c_str(), "%d.%d.%d", &major, &minor, &patch), 3);
}

}  // namespace
}  // namespace menger::io
