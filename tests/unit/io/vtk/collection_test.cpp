#include "io/vtk/collection.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

TEST(Collection, KeepsTimesFilesPartsAndNames) {
  const tests::TestFolder scratch;
  const fs::path file = scratch / "new/frames.pvd";
  const std::vector<CollectionEntry> entries{
      {0.0, "frames/a.vtu"}, {1.0 / 3.0, "frames/b & <c>.vtu", 1, "left \"half\""}, {0.5, "frames/d.vtu", 2}};
  write_collection(file, entries);
  EXPECT_EQ(read_collection(file), entries);
  const std::string text = read_whole(file);
  EXPECT_NE(text.find("<VTKFile type=\"Collection\" version=\"0.1\">"), std::string::npos) << text;
  EXPECT_NE(text.find("<DataSet timestep=\"0\" part=\"0\" file=\"frames/a.vtu\""), std::string::npos) << text;
}

TEST(Collection, RefusesAnotherFile) {
  const tests::TestFolder folder;
  write_whole(folder / "frames.pvd", "<VTKFile/>");
  EXPECT_THROW(static_cast<void>(read_collection(folder / "frames.pvd")), InputError);
  write_whole(folder / "frames.pvd", "<VTKFile><Collection><DataSet file=\"a\"/></Collection></VTKFile>");
  EXPECT_THROW(static_cast<void>(read_collection(folder / "frames.pvd")), InputError);
}

}  // namespace
}  // namespace menger::io
