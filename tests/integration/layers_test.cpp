// The link graph is the architecture: which folder may include which, where libraries are used, and what programs load.

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
  static const std::set<std::string> adapters = {"voxel_evaluator",    "study",
                                                 "study_file",         "export",
                                                 "menger-evolve",      "menger-export",
                                                 "trade_off_settled",  "reevaluation_surrogate",
                                                 "reevaluation_scene", "reevaluation_strip"};
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

/// Where the headers of a library may be included: folders, or files by their path without extension.
const std::map<std::string, std::set<std::string>>& places_of_libraries() {
  static const std::map<std::string, std::set<std::string>> places = {
      {"deal.II/", {"meshes", "fem"}},
      {"petsc", {"fem"}},
      {"slepc", {"fem"}},
      {"ceres/", {"materials/fit/separable_fit", "voxel/calibration/calibration_search"}}};
  return places;
}

TEST(Layers, SolversStayInTheirPlaces) {
  const fs::path root = MENGER_SOURCE_DIR;
  std::map<std::string, int> found;
  for (const auto& [folder, below] : allowed_includes()) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      const std::string file = fs::relative(entry.path(), root).replace_extension("").string();
      std::ifstream text(entry.path());
      for (std::string line; std::getline(text, line);) {
        for (const auto& [library, places] : places_of_libraries()) {
          if (line.rfind("#include <" + library, 0) != 0) continue;
          ++found[library];
          EXPECT_TRUE(places.count(folder) > 0 || places.count(file) > 0) << entry.path() << " includes " << line;
        }
      }
    }
  }
  EXPECT_EQ(found.size(), places_of_libraries().size()) << "a library that nobody includes, or by another name";
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

TEST(Layers, OnlyProgramsOfFiniteElementsLoadTheirLibraries) {
  for (const char* program : {"menger-evolve", "menger-simulate", "menger-export", "menger-calibrate", "menger-validate",
                              "menger-tradeoff", "menger-reevaluate", "menger-compare-searches", "menger-locomote",
                              "menger-stall-map", "menger-extremes-voxel", "menger-extremes-calibration"}) {
    const std::string libraries = needed_libraries(program);
    EXPECT_NE(libraries.find("libstdc++"), std::string::npos) << libraries;
    EXPECT_EQ(libraries.find("libdeal"), std::string::npos) << program;
    EXPECT_EQ(libraries.find("libpetsc"), std::string::npos) << program;
    EXPECT_EQ(libraries.find("libslepc"), std::string::npos) << program;
  }
  for (const char* program : {"menger-evolve", "menger-simulate"})
    EXPECT_EQ(needed_libraries(program).find("libceres"), std::string::npos) << program << " fits nothing";
  EXPECT_EQ(needed_libraries("menger-evolve").find("libvtk"), std::string::npos) << "the search draws nothing";
}

}  // namespace
}  // namespace menger
