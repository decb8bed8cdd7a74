// The link graph is the architecture: which folder may include which, and what the programs of the search load.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace menger {
namespace {

namespace fs = std::filesystem;

/// Folders whose headers a folder may include, beside its own.
const std::map<std::string, std::set<std::string>>& allowed_includes() {
  static const std::map<std::string, std::set<std::string>> allowed = {{"io", {}},
                                                                       {"materials", {"io"}},
                                                                       {"meshes", {"io", "materials"}},
                                                                       {"fem", {"io", "materials", "meshes"}},
                                                                       {"voxel", {"io", "materials", "meshes"}},
                                                                       {"evolution", {"io", "materials", "meshes"}}};
  return allowed;
}

/// The adapters of the search, which are not part of it: they join it to the voxel engine.
bool is_adapter(const fs::path& file) {
  static const std::set<std::string> adapters = {"voxel_evaluator", "study",         "study_file",
                                                 "export",          "menger-evolve", "menger-export"};
  return adapters.count(file.stem().string()) > 0;
}

/// First folder of the quoted include on a line; empty if there is none.
std::string included_folder(const std::string& line) {
  const std::string start = "#include \"";
  if (line.rfind(start, 0) != 0) return "";
  const std::size_t slash = line.find('/', start.size());
  return slash == std::string::npos ? "" : line.substr(start.size(), slash - start.size());
}

TEST(Layers, IncludeOnlyWhatStandsBelowThem) {
  const fs::path root = MENGER_SOURCE_DIR;
  int files = 0;
  for (const auto& [folder, below] : allowed_includes()) {
    if (!fs::exists(root / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path& path = entry.path();
      if (path.extension() != ".h" && path.extension() != ".cpp") continue;
      ++files;
      std::ifstream file(path);
      for (std::string line; std::getline(file, line);) {
        const std::string other = included_folder(line);
        if (other.empty() || other == folder || below.count(other) > 0) continue;
        EXPECT_TRUE(folder == "evolution" && other == "voxel" && is_adapter(path)) << path << " includes " << line;
      }
    }
  }
  EXPECT_GT(files, 50);
}

TEST(Layers, DealIIStaysBelowMeshesAndFem) {
  const fs::path root = MENGER_SOURCE_DIR;
  for (const char* folder : {"io", "materials", "voxel", "evolution"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);)
        EXPECT_EQ(line.find("#include <deal.II/"), std::string::npos) << entry.path();
    }
  }
}

/// Names of the shared libraries that a program needs, directly or not.
std::string needed_libraries(const std::string& program) {
  const std::string command = "ldd '" MENGER_PROGRAM_DIR "/" + program + "' 2>&1";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string output;
  std::array<char, 4096> buffer{};
  while (pipe && fgets(buffer.data(), static_cast<int>(buffer.size()), pipe.get()) != nullptr) output += buffer.data();
  return output;
}

TEST(Layers, ProgramsOfTheSearchLoadNoFiniteElementLibrary) {
  for (const char* program : {"menger-evolve", "menger-simulate", "menger-export"}) {
    const std::string libraries = needed_libraries(program);
    EXPECT_NE(libraries.find("libstdc++"), std::string::npos) << libraries;
    EXPECT_EQ(libraries.find("libdeal"), std::string::npos) << program;
    EXPECT_EQ(libraries.find("libpetsc"), std::string::npos) << program;
  }
  EXPECT_EQ(needed_libraries("menger-evolve").find("libvtk"), std::string::npos) << "the search draws nothing";
}

}  // namespace
}  // namespace menger
