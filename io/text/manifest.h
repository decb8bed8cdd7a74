#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace menger::io {

/// What made a folder of results: enough to make it again.
struct Manifest {
  std::string program;                        ///< e.g. "menger-simulate"
  std::string parameters;                     ///< everything that decided the result, defaults included, as text
  std::optional<std::uint64_t> seed;          ///< of the random streams, if any
  double seconds = 0.0;                       ///< wall time; comparisons of results leave it out
  std::map<std::string, std::string> inputs;  ///< input files: path as given and content_hash of what was read
};

/// Adds a file with the hash of its present content. @throws InputError if it cannot be read
void add_input(Manifest& manifest, const std::filesystem::path& file);

/// The manifest as JSON with sorted keys, the version of menger included.
std::string manifest_text(const Manifest& manifest);

/// Writes a manifest to a file, whole or not at all. @throws InputError naming path and reason
void write_manifest_file(const std::filesystem::path& file, const Manifest& manifest);

/// Writes `manifest.json` into a folder, whole or not at all. @throws InputError naming path and reason
void write_manifest(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace menger::io
