#pragma once

#include <filesystem>
#include <vector>

namespace menger::meshes {

/// The provenance files of response curves at a place, in the order of their names, so that the order of a folder does not
/// matter.
///
/// A place is a folder, in which every NAME.toml with a NAME.csv beside it counts and other results do not, or one such file,
/// which is not looked into. An empty list: a folder without any curve.
/// @throws io::InputError if nothing is there or a folder cannot be read, naming it
std::vector<std::filesystem::path> response_curve_files(const std::filesystem::path& place);

}  // namespace menger::meshes
