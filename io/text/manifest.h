#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace menger::io {

/// What is needed to make a folder of results again.
struct Manifest {
  std::string program;                        ///< e.g. "menger-simulate"
  std::string parameters;                     ///< everything that determined the result, including defaults, as text
  std::optional<std::uint64_t> seed;          ///< seed of the random streams, if any
  double seconds = 0.0;                       ///< wall time; not compared when results are compared
  std::map<std::string, std::string> inputs;  ///< of the input files, see note_input
  std::vector<std::string> notes{};           ///< sentences for readers of the results
};

/// Returns the manifest as JSON with sorted keys and the version of menger.
std::string manifest_text(const Manifest& manifest);

/// Writes a manifest to a file, whole or not at all. @throws InputError naming path and reason
void write_manifest_file(const std::filesystem::path& file, const Manifest& manifest);

/// Writes `manifest.json` into a folder, whole or not at all. @throws InputError naming path and reason
void write_manifest(const std::filesystem::path& folder, const Manifest& manifest);

/// The program that wrote a manifest; empty if there is no such file, or it is no manifest.
std::string program_of_manifest(const std::filesystem::path& file);

/// The wall time in a manifest that a program wrote, s; 0 if there is none of this program.
double seconds_of_manifest(const std::filesystem::path& file, const std::string& program);

/// The SHA-256 of what a manifest says of its results: everything but the wall time and the paths of the input files, whose
/// contents count. A run of the same program with the same inputs has the same; empty if there is no such file.
/// @throws InputError naming the file if it cannot be read
std::string hash_of_results(const std::filesystem::path& file);

}  // namespace menger::io
