#include "io/study/installed_folders.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

#include "io/text/is_file.h"
#include "io/text/joined_text.h"

namespace menger::io {

namespace fs = std::filesystem;

fs::path own_program_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

fs::path data_folder(std::string_view name) {
  const fs::path folder = own_program_folder().parent_path() / "share" / "menger" / name;
  std::error_code missing;
  const fs::path resolved = fs::canonical(folder, missing);
  return missing ? folder : resolved;
}

std::vector<fs::path> data_files(std::string_view name) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(data_folder(name), error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".toml") files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> data_names(std::string_view name) {
  std::vector<std::string> names;
  for (const fs::path& file : data_files(name)) names.push_back(file.stem().string());
  return names;
}

fs::path file_or_data(const TomlTable& table, std::string_view key, std::string_view folder) {
  const std::string name = table.text(key);
  if (name.empty() || name.find('/') != std::string::npos || is_file(table.path(key))) return table.path(key);
  for (fs::path& file : data_files(folder))
    if (file.stem() == name || file.filename() == name) return std::move(file);
  if (name.ends_with(".toml")) return table.path(key);
  const std::vector<std::string> known = data_names(folder);
  if (known.empty())
    throw table.error(key, "is no file (.toml), and those of menger are missing in " + data_folder(folder).string());
  throw table.error(key, "is neither a file (.toml) nor one of " + joined(known));
}

}  // namespace menger::io
