#include "io/study/installed_folders.h"

#include <system_error>

namespace menger::io {

namespace fs = std::filesystem;

fs::path own_program_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

fs::path data_folder(std::string_view name) {
  const fs::path folder = own_program_folder().parent_path() / "share" / "menger" / name;
  std::error_code missing;
  const fs::path resolved = fs::canonical(folder, missing);
  return missing ? folder : resolved;
}

}  // namespace menger::io
