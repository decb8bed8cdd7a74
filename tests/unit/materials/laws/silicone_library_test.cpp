#include "materials/laws/silicone_library.h"

#include <gtest/gtest.h>

#include "io/text/input_error.h"
#include "materials/laws/silicone_record.h"
#include "tests/support/input_error_message.h"

namespace menger::materials {
namespace {

namespace fs = std::filesystem;

TEST(SiliconeLibrary, FindsARecordByItsName) {
  const io::TomlTable table = io::parse_toml("silicone = \"dragon_skin_10\"\n", "study.toml");
  EXPECT_EQ(read_silicone(silicone_file(table, "silicone")).name, "Dragon Skin 10");
}

TEST(SiliconeLibrary, TakesTheFallbackOnlyWhereTheKeyIsMissing) {
  const io::TomlTable without = io::parse_toml("", "study.toml");
  EXPECT_EQ(silicone_file(without, "silicone", "ecoflex_00_30").filename(), "ecoflex_00_30.toml");
  EXPECT_THROW(silicone_file(without, "silicone"), io::InputError);
  const io::TomlTable with = io::parse_toml("silicone = \"dragon_skin_10\"\n", "study.toml");
  EXPECT_EQ(silicone_file(with, "silicone", "ecoflex_00_30").filename(), "dragon_skin_10.toml");
}

TEST(SiliconeLibrary, TakesAPathAsItIsBesideTheStudy) {
  const fs::path study = fs::path(MENGER_SOURCE_DIR) / "materials/data/study.toml";
  const io::TomlTable table = io::parse_toml("silicone = \"dragon_skin_10.toml\"\n", study);
  EXPECT_EQ(read_silicone(silicone_file(table, "silicone")).name, "Dragon Skin 10");
}

TEST(SiliconeLibrary, NamesTheRecordsThatThereAre) {
  const io::TomlTable table = io::parse_toml("silicone = \"dragon_skin\"\n", "study.toml");
  try {
    (void)silicone_file(table, "silicone");
    FAIL() << "found";
  } catch (const io::InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("study.toml"), std::string::npos) << message;
    EXPECT_NE(message.find("silicone"), std::string::npos) << message;
    EXPECT_NE(message.find("dragon_skin_10"), std::string::npos) << message;
  }
}

TEST(SiliconeLibrary, TellsATensileTestFromARecord) {
  for (const std::string name : {"tensile.csv", "tests/tensile.csv"}) {
    const io::TomlTable table = io::parse_toml("silicone = \"" + name + "\"\n", "study.toml");
    const std::string message = tests::message_of([&] { (void)silicone_file(table, "silicone"); });
    EXPECT_EQ(message, "study.toml:1: silicone = \"" + name +
                           "\": is a table, such as a tensile test, not a record of a silicone: see \"Your own silicone\" in "
                           "materials/README.md");
  }
}

TEST(SiliconeLibrary, FindsASiliconeByTheNameInItsRecord) {
  EXPECT_EQ(silicone_with_record_name("Dragon Skin 10").value().filename(), "dragon_skin_10.toml");
  EXPECT_FALSE(silicone_with_record_name("dragon_skin_10"));
}

}  // namespace
}  // namespace menger::materials
