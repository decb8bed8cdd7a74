#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace menger::io {

/// A file of a collection and its time.
struct CollectionEntry {
  double time_s = 0.0;
  std::filesystem::path file;  ///< relative to the collection
  int part = 0;                ///< number among the parts shown together at that time
  std::string name{};          ///< of the part, for people; ParaView shows it in its list of blocks

  bool operator==(const CollectionEntry&) const = default;
};

/// Writes a ParaView collection (.pvd), whole or not at all. @throws InputError if the place cannot be written
void write_collection(const std::filesystem::path& file, const std::vector<CollectionEntry>& entries);

/// Reads the entries of a collection. @throws InputError if the file is missing or is no collection
std::vector<CollectionEntry> read_collection(const std::filesystem::path& file);

}  // namespace menger::io
