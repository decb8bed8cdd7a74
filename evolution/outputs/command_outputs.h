#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evolution/outputs/stated_run.h"

namespace menger::evolution {

/// What a command of menger left in a folder, known by its manifest.
struct CommandOutput {
  std::string program{};             ///< "menger-inflate"
  std::filesystem::path folder{};    ///< where its files are
  std::filesystem::path manifest{};  ///< its manifest, absolute or as the folder was given
  std::string place{};               ///< the folder relative to that of the report; empty if it is that folder
  std::string name{};                ///< likewise, with the name of the manifest where it has one of its own
  std::string version{};             ///< of menger, empty if the manifest has none
  std::optional<double> seconds{};
  std::optional<std::uint64_t> seed{};
  std::map<std::string, std::string> inputs{};  ///< SHA-256 by file
  std::vector<std::string> notes{};
  std::string parameters{};    ///< JSON
  std::string body_name{};     ///< of the design, empty if the parameters name none
  StatedRun stated{};          ///< what the parameters state of body and motion
  bool is_calibrated = false;  ///< whether its voxels stand for hollow silicone
  std::string robot_name{};    ///< of a loop; empty for other commands
  bool robot_walks = true;     ///< false for the robot of a loop that is only inflated, such as a finger
  bool is_in_phase = false;    ///< whether all cells are driven at once: by one chamber, or by a drive in phase
};

/// The command of a program: "inflate" for "menger-inflate".
std::string command_of(const CommandOutput& output);

/// A file in the folder of an output, relative to the folder of the report: what people are told as a source.
std::string file_of(const CommandOutput& output, const std::string& file);

/// The name under which people know the body of an output: that of its design, or else where the output is.
std::string body_or_place(const CommandOutput& output);

/// The loop that made the results in the folder of a report; null if none did.
const CommandOutput* loop_of(const std::vector<CommandOutput>& outputs);

/// The name of a body in the tables of a validation, for people: a loop calls its own body "robot" there.
std::string name_in_validation(const std::string& body, const CommandOutput& validation, const CommandOutput* loop);

/// The file of voxel parameters that an output took from those that come with menger; empty if it took none of them.
std::string parameters_of_menger(const CommandOutput& output);

/// Reads a manifest. @return nothing if it is none: not JSON, or without the name of a program
/// @throws io::InputError if it cannot be read
std::optional<CommandOutput> read_command_output(const std::filesystem::path& manifest);

/// Finds what commands left in a folder and its sub-folders, by `manifest.json`, `*.manifest.json` and `*_manifest.json`, sorted
/// by name. Runs that a command made as parts of its work (folders in `runs` that have a hash for a name) are no outputs of their
/// own. Hidden folders and links are not searched.
/// @param notes gets a sentence for every manifest and folder that cannot be read
/// @throws io::InputError if the folder is none or cannot be read
std::vector<CommandOutput> find_command_outputs(const std::filesystem::path& folder, std::vector<std::string>& notes);

}  // namespace menger::evolution
