#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/text/toml_document.h"
#include "voxel/calibration/calibration_study.h"

namespace menger::voxel {

/// What all curves of a study must agree with.
struct CurveSubject {
  std::string silicone;
  std::optional<std::string> law;
  double cell_edge_m = 0.0;
  double wall_thickness_m = 0.0;
};

/// Reads the curves that a study names into it, with their hashes and what is to be known of them.
/// @param given files and folders in place of the study's `curves`, if there are any
/// @param study whose number of voxels, chambers and range of pressures are known
/// @throws io::InputError, see read_calibration_study
void read_curves(const io::TomlTable& top, const std::vector<std::filesystem::path>& given, CurveSubject wanted,
                 CalibrationStudy& study);

}  // namespace menger::voxel
