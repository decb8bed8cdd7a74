#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/study/study_visitor.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// Stands in place of an interval in the report of a fit, for a value that the curves do not determine.
inline constexpr std::string_view not_determined = "not determined";

std::string_view to_string(meshes::ChamberLayout layout);  ///< "single" or "per-phase"

/// Describes the keys of voxel parameters. Lists of seven numbers are ordered by wall class.
///
/// A reader refuses a law that has its pole within the range of validity of its wall class, or an extension that leaves no length
/// there. Where a cell has several voxels, it takes the ranges of all classes.
void describe(io::StudyVisitor& visitor, SurrogateParameters& parameters);

/// Returns parameters as the TOML that read_surrogate reads. The text is exact and always in the same order: equal texts mean
/// equal parameters.
std::string surrogate_text(const SurrogateParameters& parameters);

/// Reads voxel parameters, also files that earlier versions wrote. A table `[fit]`, in which a calibration reports how it found
/// them, is not read except for its status and for intervals that are not determined. A file
/// whose status is not "completed" is refused, and one with a number that is not finite, wherever it stands.
/// @throws io::InputError with file, key and value
SurrogateParameters read_surrogate(const std::filesystem::path& file);

}  // namespace menger::voxel
