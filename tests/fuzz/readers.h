#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace menger::tests {

/// A reader of menger, as fuzzers and the test of their corpus call it.
struct FuzzedReader {
  std::string_view name;  ///< as a word: "evolve"; its seeds and its corpus are in folders of this name
  std::string_view file;  ///< name of the file that it reads, from the root of the sources: relative names in it lead into these

  /// Reads the file. @throws io::InputError if it refuses it; every other exception is a fault
  void (*read)(const std::filesystem::path& file);
};

/// Returns all readers.
std::span<const FuzzedReader> fuzzed_readers();

/// Returns the reader of this name; nullptr if there is none.
const FuzzedReader* fuzzed_reader(std::string_view name);

/// Makes a folder that looks like the sources to the file of a reader: links to them, and a folder of its own where the file
/// goes.
/// @param root an empty folder
/// @return the path of the file, which does not exist yet
std::filesystem::path fuzzed_place(const FuzzedReader& reader, const std::filesystem::path& root);

/// Writes a file and lets a reader read it. Returns the message if the reader refuses it; empty if it does not.
/// @throws std::runtime_error if the message names no file below `root`, holds a control character or is not one of an InputError
std::string read_fuzzed(const FuzzedReader& reader, const std::filesystem::path& root, const std::filesystem::path& file,
                        std::string_view content);

}  // namespace menger::tests
