#pragma once

#include <filesystem>
#include <system_error>

namespace menger::io {

/// Returns whether there is a file of this name, itself or through links. What cannot be looked at counts as missing.
inline bool is_file(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored);
}

}  // namespace menger::io
