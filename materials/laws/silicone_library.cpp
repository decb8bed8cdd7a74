#include "materials/laws/silicone_library.h"

#include <algorithm>
#include <vector>

#include "io/study/installed_folders.h"
#include "io/text/is_file.h"
#include "materials/laws/silicone_record.h"

namespace menger::materials {

namespace fs = std::filesystem;

fs::path silicone_file(const io::TomlTable& table, std::string_view key, const std::string& fallback) {
  if (table.is_text(key) && table.text(key).ends_with(".csv")) {
    throw table.error(key,
                      "is a table, such as a tensile test, not a record of a silicone: see \"Your own silicone\" in "
                      "materials/README.md");
  }
  if (!fallback.empty() && table.text_or(key, fallback) == fallback && !table.has(key)) return *silicone_of_menger(fallback);
  return io::file_or_data(table, key, io::silicone_data);
}

std::optional<fs::path> silicone_of_menger(std::string_view name) {
  fs::path file = io::data_folder(io::silicone_data) / (std::string(name) + ".toml");
  if (name.find('/') != std::string_view::npos || !io::is_file(file)) return std::nullopt;
  return file;
}

std::optional<fs::path> silicone_with_record_name(std::string_view name) {
  const std::vector<fs::path> files = io::data_files(io::silicone_data);
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const fs::path& file) { return read_silicone(file).name == name; });
  return found == files.end() ? std::nullopt : std::optional(*found);
}

}  // namespace menger::materials
