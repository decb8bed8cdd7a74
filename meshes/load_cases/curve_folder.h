#pragma once

#include <filesystem>
#include <vector>

namespace menger::meshes {

/// Returns the provenance files of the response curves at a place, sorted by name.
///
/// A place is a folder or one provenance file. In a folder, every NAME.toml with a NAME.csv beside it is returned; other files
/// are ignored. A single file is returned without being opened. The list is empty for a folder without curves.
/// @throws io::InputError naming the place if nothing is there or a folder cannot be read
std::vector<std::filesystem::path> response_curve_files(const std::filesystem::path& place);

}  // namespace menger::meshes
