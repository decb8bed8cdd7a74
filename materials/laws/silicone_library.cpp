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
  std::error_code ignored;
  if (fs::path file = record_folder() / (name + ".toml"); fs::is_regular_file(file, ignored)) return file;
  throw table.error(key, "is neither a file (.toml) nor one of " + known_records());
}

}  // namespace menger::materials
