#include "materials/curve_folder.h"

#include <gtest/gtest.h>

#include <string>

#include "io/input_error.h"
#include "io/whole_file.h"

namespace menger::materials {
namespace {

namespace fs = std::filesystem;

class CurveFolder : public testing::Test {
 protected:
  CurveFolder() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~CurveFolder() override { fs::remove_all(folder_); }

  void make(const std::string& name) const { io::write_whole(folder_ / name, ""); }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / "curve_folder" / testing::UnitTest::GetInstance()->current_test_info()->name();
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
    EXPECT_NE(std::string(error.what()).find("absent: is not there"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace menger::materials
