#pragma once

#include <filesystem>
#include <string_view>

namespace menger::io {

/// Returns the folder that the running program lies in, with links resolved. The programs of menger lie in one folder.
std::filesystem::path own_program_folder();

/// Returns a folder of the data files that come with menger: share/menger/NAME, beside the folder of the running program. So
/// a program finds them wherever menger was installed, and in a build, where the folder is a link into the sources.
/// @param name "materials" (records of silicones) or "parameters" (fitted voxel parameters)
/// @return the path with links resolved if the folder is there; otherwise the place where it should be
std::filesystem::path data_folder(std::string_view name);

}  // namespace menger::io
