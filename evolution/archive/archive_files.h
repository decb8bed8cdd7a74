#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/text/is_file.h"

namespace menger::evolution {

/// Returns the file that lies beside an archive and is named after it, because several runs may share a folder:
/// run.manifest.json beside run.sqlite, and trial.1.manifest.json beside trial.1.
/// @param ending ".manifest.json"
inline std::filesystem::path beside_archive(std::filesystem::path archive, std::string_view ending) {
  if (archive.extension() == ".sqlite") archive.replace_extension();
  return archive += ending;
}

/// Returns the archive that such a file lies beside: run.sqlite for run.manifest.json, or run if there is only that.
inline std::filesystem::path archive_beside(const std::filesystem::path& file, std::string_view ending) {
  std::string name = file.filename().string();
  name.resize(name.size() - std::min(name.size(), ending.size()));
  const std::filesystem::path archive = file.parent_path() / (name + ".sqlite");
  const std::filesystem::path bare = file.parent_path() / name;
  return !io::is_file(archive) && io::is_file(bare) ? bare : archive;
}

}  // namespace menger::evolution
