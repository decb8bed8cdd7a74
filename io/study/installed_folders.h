#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/toml_document.h"

namespace menger::io {

/// Names of data folders.
inline constexpr std::string_view silicone_data = "materials";    ///< records of silicones
inline constexpr std::string_view parameter_data = "parameters";  ///< fitted voxel parameters

/// Returns the folder that the running program lies in, with links resolved. The programs of menger lie in one folder.
std::filesystem::path own_program_folder();

/// Returns a folder of the data files that come with menger: share/menger/NAME, beside the folder of the running program. So
/// a program finds them wherever menger was installed, and in a build, where the folder is a link into the sources.
/// @param name one of the names above
/// @return the path with links resolved if the folder is there; otherwise the place where it should be
std::filesystem::path data_folder(std::string_view name);

/// Returns the files (.toml) of a data folder, by name; none if it is not there.
std::vector<std::filesystem::path> data_files(std::string_view name);

/// Returns the names of those files, without ".toml".
std::vector<std::string> data_names(std::string_view name);

/// Returns the file that a text of a table names: a path, counted from the file of the table, if it has a "/" or is a file, else
/// the data file of that name, such as "dragon_skin_10" or "dragon_skin_10.toml". Another text that ends in .toml is a path, too.
/// @param folder name of the data folder
/// @throws InputError naming the key and the data files that there are, if there is none of that name
std::filesystem::path file_or_data(const TomlTable& table, std::string_view key, std::string_view folder);

}  // namespace menger::io
