#pragma once

#include <filesystem>
#include <vector>

#include "io/text/toml_document.h"
#include "voxel/calibration/calibration_study.h"

namespace menger::voxel {

/// Reads the curves that a study names into it, with their hashes and what is to be known of them.
/// @param top of the study's file, for messages @param given files and folders in place of the study's, if there are any
/// @throws io::InputError, see read_calibration_study
void read_curves(const io::TomlTable& top, const std::vector<std::filesystem::path>& given, CalibrationStudy& study);

}  // namespace menger::voxel
