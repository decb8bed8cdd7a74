#pragma once

#include <filesystem>
#include <vector>

#include "io/text/toml_document.h"
#include "voxel/calibration/calibration_study.h"

namespace menger::voxel {

/// Reads the curves that a study names, and adds them to it with their hashes and notes.
/// @param top of the study's file, for messages @param given files and folders to read in place of the study's, if any
/// @throws io::InputError, see read_calibration_study
void read_curves(const io::TomlTable& top, const std::vector<std::filesystem::path>& given, CalibrationStudy& study);

}  // namespace menger::voxel
