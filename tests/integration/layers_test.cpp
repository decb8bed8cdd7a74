// Checks the architecture: which room may include which, where libraries are used, and which libraries programs load.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/test_folder.h"

namespace menger {
namespace {

namespace fs = std::filesystem;

using Words = std::set<std::string>;

const std::vector<std::string>& folders() {
  static const std::vector<std::string> names = {"io", "materials", "meshes", "voxel", "fem", "evolution"};
  return names;
}

/// The entry of a room in cmake/rooms.md.
struct Room {
  Words direct;     ///< rooms that it depends on directly
  Words below;      ///< all rooms that it depends on, directly or not
  Words libraries;  ///< libraries whose headers it may include
};

using Rooms = std::map<std::string, Room>;

/// Returns all matches of an expression in a text.
Words words(const std::string& text, const std::string& expression) {
  const std::regex word(expression);
  return {std::sregex_token_iterator(text.begin(), text.end(), word), std::sregex_token_iterator()};
}

/// Reads the table of rooms. It is a failure if a line names a room that no line above describes.
Rooms read_rooms(std::istream& table) {
  static const std::regex row(R"(\| `([a-z_]+/[a-z_]+)` \|([^|]*)\|([^|]*)\|)");
  Rooms rooms;
  for (std::string line; std::getline(table, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    Room room;
    room.direct = words(match[2], "[a-z_]+/[a-z_]+");
    room.libraries = words(match[3], R"([A-Za-z0-9.+\-]+)");
    for (const std::string& other : room.direct) {
      const auto found = rooms.find(other);
      if (found == rooms.end()) {
        ADD_FAILURE() << match[1] << " stands on " << other << ", which is not a room above it";
        continue;
      }
      room.below.insert(other);
      room.below.insert(found->second.below.begin(), found->second.below.end());
    }
    EXPECT_TRUE(rooms.emplace(match[1], std::move(room)).second) << match[1] << " is there twice";
  }
  return rooms;
}

Rooms rooms_of_menger() {
  std::ifstream table(fs::path(MENGER_SOURCE_DIR) / "cmake/rooms.md");
  return read_rooms(table);
}

/// Returns the beginnings of names of headers, each with its library.
const std::map<std::string, std::string>& libraries() {
  static const std::map<std::string, std::string> of_prefix = {{"boost/", "Boost"},
                                                               {"ceres/", "Ceres"},
                                                               {"CLI/", "CLI11"},
                                                               {"deal.II/", "deal.II"},
                                                               {"Eigen/", "Eigen"},
                                                               {"glog/", "glog"},
                                                               {"gmsh.h", "Gmsh"},
                                                               {"mpi.h", "MPI"},
                                                               {"nlohmann/", "nlohmann-json"},
                                                               {"oneapi/tbb", "oneTBB"},
                                                               {"GL/", "OpenGL"},
                                                               {"openssl/", "OpenSSL"},
                                                               {"petsc", "PETSc"},
                                                               {"slepc", "SLEPc"},
                                                               {"SQLiteCpp/", "SQLiteCpp"},
                                                               {"arkode/", "SUNDIALS"},
                                                               {"cooperative_groups", "CUDA"},
                                                               {"cuda_runtime", "CUDA"},
                                                               {"ida/", "SUNDIALS"},
                                                               {"kinsol/", "SUNDIALS"},
                                                               {"nvector/", "SUNDIALS"},
                                                               {"sundials/", "SUNDIALS"},
                                                               {"sunlinsol/", "SUNDIALS"},
                                                               {"sunmatrix/", "SUNDIALS"},
                                                               {"toml++/", "toml++"},
                                                               {"vtk", "VTK"},
                                                               {"X11/", "X11"},
                                                               {"xsimd/", "xsimd"}};
  return of_prefix;
}

/// Returns the library of a header: empty for headers of C++ and of the system, "an unknown library" for all others.
std::string library_of(const std::string& header) {
  static const std::regex of_system(R"([a-z_]+|(sys|sanitizer)/.*|(fcntl|poll|semaphore|unistd)\.h)");
  for (const auto& [prefix, library] : libraries())
    if (header.starts_with(prefix)) return library;
  return std::regex_match(header, of_system) ? "" : "an unknown library";
}

/// Returns the sources of a tree, each with its room: `fem/space` for `fem/space/space.cpp`, `fem` for a file that is in no room.
std::vector<std::pair<fs::path, std::string>> sources(const fs::path& root) {
  std::vector<std::pair<fs::path, std::string>> files;
  for (const std::string& folder : folders()) {
    if (!fs::exists(root / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(".h") || name.ends_with(".cpp") || name.ends_with(".cpp.in") || name.ends_with(".cu") ||
          name.ends_with(".cuh"))
        files.emplace_back(entry.path(), fs::relative(entry.path().parent_path(), root).string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Returns the names that a file includes, in quotes or in angle brackets.
Words includes(const fs::path& file, bool quoted) {
  static const std::regex in_quotes(R"re(\s*#\s*include\s*"([^"]+)".*)re");
  static const std::regex in_brackets(R"re(\s*#\s*include\s*<([^>]+)>.*)re");
  Words names;
  std::ifstream text(file);
  for (std::string line; std::getline(text, line);) {
    std::smatch match;
    if (std::regex_match(line, match, quoted ? in_quotes : in_brackets)) names.insert(match[1]);
  }
  return names;
}

/// Returns every include of a tree that its table of rooms does not allow, a line each.
std::vector<std::string> wrong_includes(const fs::path& root, const Rooms& rooms) {
  std::vector<std::string> wrong;
  for (const auto& [file, name] : sources(root)) {
    const std::string path = fs::relative(file, root).string();
    const auto room = rooms.find(name);
    if (room == rooms.end()) {
      wrong.push_back(path + " lies in no room of the table");
      continue;
    }
    for (const std::string& include : includes(file, true)) {
      const std::string other = fs::path(include).parent_path().string();
      if (!fs::exists(root / include))
        wrong.push_back(path + " includes " + include + ", which is not there");
      else if (other != name && !room->second.below.contains(other))
        wrong.push_back(path + " includes " + include + ", but " + name + " does not stand on " + other);
    }
    for (const std::string& include : includes(file, false)) {
      const std::string library = library_of(include);
      if (!library.empty() && !room->second.libraries.contains(library))
        wrong.push_back(path + " includes " + include + " of " + library);
    }
  }
  return wrong;
}

TEST(Rooms, IncludeOnlyWhatTheTableAllows) {
  const Rooms rooms = rooms_of_menger();
  EXPECT_GT(rooms.size(), 40U);
  EXPECT_GT(sources(MENGER_SOURCE_DIR).size(), 700U);
  for (const std::string& wrong : wrong_includes(MENGER_SOURCE_DIR, rooms)) ADD_FAILURE() << wrong;
}

TEST(Rooms, APlantedIncludeIsFound) {
  const tests::TestFolder folder;
  const auto plant = [&](const std::string& file, const std::string& text) {
    fs::create_directories((folder / file).parent_path());
    std::ofstream(folder / file) << text << '\n';
  };
  std::istringstream table(
      "| `io/text` | | toml++ |\n| `fem/space` | `io/text` | deal.II |\n| `fem/statics` | `fem/space` | |\n| `voxel/engine` | "
      "`io/text` | |\n");
  const Rooms rooms = read_rooms(table);
  plant("io/text/a.h", "#include <vector>");
  plant("fem/space/b.h", "#include <deal.II/base/point.h>\n#include \"io/text/a.h\"");
  plant("fem/statics/c.cpp", "#include \"fem/space/b.h\"\n#include \"io/text/a.h\"");
  plant("voxel/engine/d.h", "#include \"io/text/a.h\"");
  EXPECT_EQ(wrong_includes(folder.path(), rooms), std::vector<std::string>{});

  plant("fem/space/upwards.h", "  # include \"fem/statics/c.h\"");
  plant("fem/statics/c.h", "");
  plant("fem/statics/library.cpp", "#include <deal.II/fe/fe_q.h>");
  plant("fem/statics/unknown.cpp", "#include <hdf5.h>\n#include <unistd.h>\n#include <sys/stat.h>");
  plant("fem/statics/missing.cpp", "#include \"io/text/gone.h\"");
  plant("io/text/sideways.cpp", "#include \"voxel/engine/d.h\"");
  plant("voxel/roomless.cpp", "");
  EXPECT_EQ(
      wrong_includes(folder.path(), rooms),
      (std::vector<std::string>{"fem/space/upwards.h includes fem/statics/c.h, but fem/space does not stand on fem/statics",
                                "fem/statics/library.cpp includes deal.II/fe/fe_q.h of deal.II",
                                "fem/statics/missing.cpp includes io/text/gone.h, which is not there",
                                "fem/statics/unknown.cpp includes hdf5.h of an unknown library",
                                "io/text/sideways.cpp includes voxel/engine/d.h, but io/text does not stand on voxel/engine",
                                "voxel/roomless.cpp lies in no room of the table"}));
}

TEST(Rooms, StandOnWhatTheyInclude) {
  const Rooms rooms = rooms_of_menger();
  std::map<std::string, Words> included_rooms;
  std::map<std::string, Words> included_libraries;
  for (const auto& [file, name] : sources(MENGER_SOURCE_DIR)) {
    for (const std::string& include : includes(file, true)) included_rooms[name].insert(fs::path(include).parent_path().string());
    for (const std::string& include : includes(file, false)) {
      for (const auto& [prefix, library] : libraries())
        if (include.starts_with(prefix)) included_libraries[name].insert(library);
    }
  }
  for (const auto& [name, room] : rooms) {
    for (const std::string& other : room.direct) {
      EXPECT_TRUE(included_rooms[name].contains(other)) << name << " includes nothing of " << other;
      for (const std::string& between : room.direct)
        EXPECT_FALSE(rooms.at(between).below.contains(other)) << name << " stands on " << other << " by " << between << " anyway";
    }
    for (const std::string& library : room.libraries) {
      EXPECT_TRUE(included_libraries[name].contains(library)) << name << " includes nothing of " << library;
    }
  }
}

TEST(Rooms, WalksNeedNoMeshLibraryPicturesOrFiles) {
  const Rooms rooms = rooms_of_menger();
  Words closure = rooms.at("fem/walk").below;
  closure.insert("fem/walk");
  for (const std::string& name : closure) {
    for (const char* library : {"deal.II", "PETSc", "SLEPc", "MPI", "VTK", "Gmsh", "SQLiteCpp", "CLI11"})
      EXPECT_FALSE(rooms.at(name).libraries.contains(library)) << "fem/walk stands on " << name << ", which includes " << library;
  }
  for (const char* name : {"fem/space", "io/process", "io/picture", "io/vtk", "meshes/files", "fem/locomotion"})
    EXPECT_FALSE(closure.contains(name)) << "fem/walk stands on " << name;
  std::size_t looked_at = 0;
  for (const auto& [file, name] : sources(MENGER_SOURCE_DIR)) {
    if (name != "fem/walk") continue;
    ++looked_at;
    Words there = includes(file, true);
    there.merge(includes(file, false));
    for (const char* of_files : {"filesystem", "fstream", "io/text/whole_file.h", "io/process/checkpoint_file.h",
                                 "io/text/toml_document.h", "io/text/csv_table.h"})
      EXPECT_FALSE(there.contains(of_files)) << file << " includes " << of_files;
  }
  EXPECT_GT(looked_at, 10U);
}

TEST(Rooms, AreOfOneConceptEach) {
  constexpr int most_files = 38;  // as CONTRIBUTING.md says
  std::map<std::string, int> files;
  for (const auto& [file, name] : sources(MENGER_SOURCE_DIR)) ++files[name];
  for (const auto& [name, count] : files) EXPECT_LE(count, most_files) << name << " holds more than one concept";
}

TEST(Rooms, AreInTheReadmeOfTheirFolder) {
  const fs::path root = MENGER_SOURCE_DIR;
  static const std::regex row(R"(\| \[?`([a-z_]+)`\]?(?:\([^)]*\))? \| ([^|]+) \| `([a-z_0-9]+\.h)` \|)");
  for (const std::string& folder : folders()) {
    Words described;
    std::ifstream text(root / folder / "README.md");
    for (std::string line; std::getline(text, line);) {
      std::smatch match;
      if (!std::regex_match(line, match, row)) continue;
      described.insert(folder + "/" + match[1].str());
      EXPECT_TRUE(fs::exists(root / folder / match[1].str() / match[3].str())) << folder << "/README.md: " << line;
    }
    Words there;
    for (const auto& [name, room] : rooms_of_menger())
      if (name.starts_with(folder + "/") && !name.ends_with("/apps")) there.insert(name);
    EXPECT_EQ(described, there) << folder << "/README.md";
  }
}

/// Returns the names of the shared libraries that a program needs, directly or not.
std::string needed_libraries(const std::string& program) {
  const std::string command = "ldd '" MENGER_PROGRAM_DIR "/" + program + "' 2>&1";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string output;
  std::array<char, 4096> buffer{};
  while (pipe && fgets(buffer.data(), static_cast<int>(buffer.size()), pipe.get()) != nullptr) output += buffer.data();
  return output;
}

TEST(Programs, OnlyProgramsOfFiniteElementsLoadTheirLibraries) {
  for (const char* program :
       {"menger-evolve", "menger-init", "menger-loop", "menger-simulate", "menger-export", "menger-calibrate", "menger-validate",
        "menger-tradeoff", "menger-reevaluate", "menger-report", "menger-compare-searches", "menger-confirm", "menger-locomote",
        "menger-stall-map", "menger-extremes-voxel", "menger-extremes-calibration"}) {
    const std::string libraries = needed_libraries(program);
    EXPECT_NE(libraries.find("libstdc++"), std::string::npos) << libraries;
    EXPECT_EQ(libraries.find("libdeal"), std::string::npos) << program;
    EXPECT_EQ(libraries.find("libpetsc"), std::string::npos) << program;
    EXPECT_EQ(libraries.find("libslepc"), std::string::npos) << program;
  }
  for (const char* program : {"menger-evolve", "menger-simulate"})
    EXPECT_EQ(needed_libraries(program).find("libceres"), std::string::npos) << program << " fits nothing";
  EXPECT_EQ(needed_libraries("menger-simulate").find("libsundials"), std::string::npos) << "voxels solve no equations";
  EXPECT_EQ(needed_libraries("menger-evolve").find("libvtk"), std::string::npos) << "the search draws nothing";
}

}  // namespace
}  // namespace menger
