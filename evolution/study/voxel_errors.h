#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evolution/study/study.h"
#include "voxel/model/expected_errors.h"

namespace menger::evolution {

/// What is known of the errors of the calibrated voxels of a search.
struct VoxelErrors {
  voxel::KnownErrors known{};
  std::optional<std::filesystem::path> table{};  ///< the file that it was read from, if one was
  std::vector<std::string> text{};               ///< sentences for people: what to expect of bodies of each kind
};

/// Finds what is known of the errors of the voxels of a study; nothing if no calibrated voxels move in it.
/// @param file of the study, which names the parameters
/// @throws io::InputError if it, or a table of errors, cannot be read
std::optional<VoxelErrors> voxel_errors(const Study& study, const std::filesystem::path& file);

}  // namespace menger::evolution
