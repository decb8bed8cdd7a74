#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace menger::evolution {

/// Cells of a body as a manifest names them: `layers[z][y][x]` is '0', '1' or '2'.
struct ManifestBody {
  std::vector<std::vector<std::string>> layers;
  double cell_edge_m = 0.0;
  bool operator==(const ManifestBody&) const = default;
};

/// What a command of menger left in a folder, known by its manifest.
struct CommandOutput {
  std::string program;             ///< "menger-inflate"
  std::filesystem::path folder;    ///< where its files are
  std::filesystem::path manifest;  ///< its manifest, absolute or as the folder was given
  std::string name;     ///< the folder relative to that of the report, with the name of the manifest where it has one of its own
  std::string version;  ///< of menger, empty if the manifest has none
  std::optional<double> seconds{};
  std::optional<std::uint64_t> seed{};
  std::map<std::string, std::string> inputs{};  ///< SHA-256 by file
  std::vector<std::string> notes{};
  std::string parameters{};            ///< JSON
  std::string body_name{};             ///< of the design, empty if the parameters name none
  std::optional<ManifestBody> body{};  ///< if the parameters have a design of level 1
  bool is_calibrated = false;          ///< whether its voxels stand for hollow silicone
  bool is_in_phase = false;            ///< whether all cells are driven at once: by one chamber, or by a drive in phase
  std::string drive{};                 ///< mode, pressures and frequency of the drive as JSON; empty without one
};

/// The command of a program: "inflate" for "menger-inflate".
std::string command_of(const CommandOutput& output);

/// Reads a manifest. @return nothing if it is none: not JSON, or without the name of a program
/// @throws io::InputError if it cannot be read
std::optional<CommandOutput> read_command_output(const std::filesystem::path& manifest);

/// Finds what commands left in a folder and its sub-folders, by `manifest.json`, `*.manifest.json` and `*_manifest.json`, sorted
/// by name. Folders that a command made for parts of its work (`runs`, `cache`, `frames`, `fields`) are not searched, and neither
/// are hidden ones and links.
/// @param notes gets a sentence for every manifest and folder that cannot be read
/// @throws io::InputError if the folder is none or cannot be read
std::vector<CommandOutput> find_command_outputs(const std::filesystem::path& folder, std::vector<std::string>& notes);

}  // namespace menger::evolution
