#include "materials/laws/silicone_library.h"

#include <algorithm>
#include <system_error>
#include <vector>

namespace menger::materials {
namespace {

namespace fs = std::filesystem;

const fs::path& record_folder() {
  static const fs::path folder(MENGER_MATERIAL_FOLDER);
  return folder;
}

std::string known_records() {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(record_folder(), error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".toml") names.push_back(entry->path().stem().string());
  }
  std::sort(names.begin(), names.end());
  std::string list;
  for (const std::string& name : names) list.append(list.empty() ? "" : ", ").append(name);
  return list;
}

}  // namespace

fs::path silicone_file(const io::TomlTable& table, std::string_view key, const std::string& fallback) {
  const std::string name = fallback.empty() ? table.text(key) : table.text_or(key, fallback);
  if (name.find('/') != std::string::npos || fs::path(name).extension() == ".toml") return table.path(key);
  if (const auto file = silicone_of_menger(name)) return *file;
  throw table.error(key, "is neither a file (.toml) nor one of " + known_records());
}

std::optional<fs::path> silicone_of_menger(std::string_view name) {
  std::error_code ignored;
  fs::path file = record_folder() / (std::string(name) + ".toml");
  if (name.find('/') != std::string_view::npos || !fs::is_regular_file(file, ignored)) return std::nullopt;
  return file;
}

}  // namespace menger::materials
