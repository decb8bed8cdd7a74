#include "meshes/load_cases/curve_folder.h"

#include <algorithm>
#include <system_error>

#include "io/text/input_error.h"

namespace menger::meshes {

namespace fs = std::filesystem;

std::vector<fs::path> response_curve_files(const fs::path& place) {
  std::error_code error;
  if (!fs::exists(place, error))
    throw io::InputError(place.string() + ": does not exist; give a folder of response curves, or the .toml file of one curve");
  if (!fs::is_directory(place, error)) return {place};
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(place, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    const fs::path& file = entry->path();
    const bool has_table = fs::exists(fs::path(file).replace_extension(".csv"), ignored);
    if (file.extension() == ".toml" && has_table) files.push_back(file);
  }
  if (error) throw io::InputError(place.string() + ": cannot be read: " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace menger::meshes
