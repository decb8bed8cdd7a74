#pragma once

#include <filesystem>
#include <string>

namespace menger::test_support {

/// Copies a program of menger to folder/bin/NAME, and leads it to the data files that it would find beside the original.
inline void copy_program(const std::filesystem::path& program, const std::filesystem::path& folder, const std::string& name) {
  namespace fs = std::filesystem;
  fs::create_directories(folder / "bin");
  fs::copy_file(program, folder / "bin" / name);
  fs::create_directories(folder / "share");
  fs::create_directory_symlink(program.parent_path().parent_path() / "share/menger", folder / "share/menger");
}

}  // namespace menger::test_support
