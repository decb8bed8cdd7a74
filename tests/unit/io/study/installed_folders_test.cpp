#include "io/study/installed_folders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "io/text/input_error.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

fs::path named(const std::string& text) {
  const TomlTable table = parse_toml("parameters = \"" + text + "\"\n", "folder/study.toml");
  return file_or_data(table, "parameters", parameter_data);
}

TEST(InstalledFolders, DataFilesAreSortedAndThere) {
  const auto files = data_files(parameter_data);
  ASSERT_FALSE(files.empty());
  EXPECT_TRUE(std::ranges::is_sorted(files));
  EXPECT_TRUE(std::ranges::all_of(files, [](const fs::path& file) { return fs::is_regular_file(file); }));
  EXPECT_TRUE(data_files("of nothing").empty());
}

TEST(InstalledFolders, NameIsThatOfADataFile) {
  EXPECT_EQ(named("dragon_skin_10_1cm"), data_folder(parameter_data) / "dragon_skin_10_1cm.toml");
  EXPECT_EQ(named("dragon_skin_10_0.667cm"), data_folder(parameter_data) / "dragon_skin_10_0.667cm.toml") << "no suffix";
  EXPECT_EQ(named("dragon_skin_10_1cm.toml"), data_folder(parameter_data) / "dragon_skin_10_1cm.toml")
      << "as programs print it, and there is no such file beside the table";
}

TEST(InstalledFolders, PathCountsFromTheFileOfItsTable) {
  EXPECT_EQ(named("my_fit.toml"), fs::path("folder/my_fit.toml"));
  EXPECT_EQ(named("fits/bar"), fs::path("folder/fits/bar"));
  EXPECT_EQ(named("/fits/bar.toml"), fs::path("/fits/bar.toml"));
}

TEST(InstalledFolders, UnknownNameIsRefusedWithThoseThatThereAre) {
  try {
    named("dragon_skin");
    FAIL() << "found";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("folder/study.toml:1: parameters = \"dragon_skin\": is neither a file (.toml) nor one of "),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("ecoflex_00_30_12mm"), std::string::npos) << message;
  }
  EXPECT_THROW(named(""), InputError);
}

}  // namespace
}  // namespace menger::io
