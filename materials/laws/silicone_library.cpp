#include "materials/laws/silicone_library.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "io/study/installed_folders.h"
#include "io/text/is_file.h"
#include "materials/laws/silicone_record.h"

namespace menger::materials {
namespace {

namespace fs = std::filesystem;

const fs::path& record_folder() {
  static const fs::path folder = io::data_folder("materials");
  return folder;
}

/// Returns the files of all records, by name.
std::vector<fs::path> record_files() {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(record_folder(), error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".toml") files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string known_records() {
  std::string list;
  for (const fs::path& file : record_files()) list.append(list.empty() ? "" : ", ").append(file.stem().string());
  return list;
}

}  // namespace

fs::path silicone_file(const io::TomlTable& table, std::string_view key, const std::string& fallback) {
  const std::string name = fallback.empty() ? table.text(key) : table.text_or(key, fallback);
  if (name.find('/') != std::string::npos || fs::path(name).extension() == ".toml") return table.path(key);
  if (const auto file = silicone_of_menger(name)) return *file;
  const std::string known = known_records();
  if (known.empty())
    throw table.error(key, "is no file (.toml), and the silicones of menger are missing in " + record_folder().string());
  throw table.error(key, "is neither a file (.toml) nor one of " + known);
}

std::optional<fs::path> silicone_of_menger(std::string_view name) {
  fs::path file = record_folder() / (std::string(name) + ".toml");
  if (name.find('/') != std::string_view::npos || !io::is_file(file)) return std::nullopt;
  return file;
}

std::optional<fs::path> silicone_with_record_name(std::string_view name) {
  const std::vector<fs::path> files = record_files();
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const fs::path& file) { return read_silicone(file).name == name; });
  return found == files.end() ? std::nullopt : std::optional(*found);
}

}  // namespace menger::materials
