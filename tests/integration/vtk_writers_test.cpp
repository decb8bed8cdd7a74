// Every file for ParaView is written by io::write_vtu, the only place with the format that ParaView needs.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

namespace menger {
namespace {

namespace fs = std::filesystem;

/// Returns whether a line writes data with VTK or deal.II directly. Pictures (PNG) do not count. A collection or a parallel file
/// only names other files and may be written as text.
bool writes_data(const std::string& line) {
  static const std::regex other_ways(
      "#include <vtk\\w*Writer|#include <deal\\.II/(numerics/data_out|grid/grid_out)|SetDataMode|"
      "AppendedData|<DataArray|# vtk DataFile");
  return std::regex_search(line, other_ways) && line.find("#include <vtkPNGWriter.h>") == std::string::npos;
}

TEST(VtkWriters, StandInOneFile) {
  const fs::path root = MENGER_SOURCE_DIR;
  int files = 0;
  int writers = 0;
  for (const char* folder : {"io", "materials", "meshes", "fem", "voxel", "evolution"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path& path = entry.path();
      if (path.extension() != ".h" && path.extension() != ".cpp") continue;
      ++files;
      std::ifstream text(path);
      for (std::string line; std::getline(text, line);) {
        if (!writes_data(line)) continue;
        ++writers;
        EXPECT_EQ(fs::relative(path, root), "io/vtk/vtk_file.cpp") << path << ": " << line;
      }
    }
  }
  EXPECT_GT(files, 500);
  EXPECT_GT(writers, 0) << "io::write_vtu itself is not found";
}

}  // namespace
}  // namespace menger
