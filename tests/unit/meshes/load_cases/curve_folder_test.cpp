#include "meshes/load_cases/curve_folder.h"

#include <gtest/gtest.h>

#include <string>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::meshes {
namespace {

namespace fs = std::filesystem;

class CurveFolder : public testing::Test {
 protected:
  void make(const std::string& name) const { io::write_whole(folder_ / name, ""); }

  const tests::TestFolder folder_;
};

TEST_F(CurveFolder, HoldsTheProvenanceFilesWithATableInOrder) {
  for (const char* name : {"b.toml", "b.csv", "a.csv", "a.toml", "summary.toml", "other.csv", "a.png"}) make(name);
  EXPECT_EQ(response_curve_files(folder_), (std::vector<fs::path>{folder_ / "a.toml", folder_ / "b.toml"}));
}

TEST_F(CurveFolder, MayBeEmptyOrAFile) {
  EXPECT_TRUE(response_curve_files(folder_).empty());
  make("one.toml");
  EXPECT_EQ(response_curve_files(folder_ / "one.toml"), (std::vector<fs::path>{folder_ / "one.toml"}));
}

TEST_F(CurveFolder, MustBeThere) {
  try {
    (void)response_curve_files(folder_ / "absent");
    ADD_FAILURE() << "accepted";
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("absent: does not exist"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace menger::meshes
