#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/study/study_visitor.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

std::string_view to_string(meshes::ChamberLayout layout);  ///< "single" or "per-phase"

/// The keys of voxel parameters. Lists of seven numbers go by wall class.
///
/// A reader refuses a law with its pole, or a size that vanishes, within the range of validity of its wall class (of any, where a
/// cell has several voxels).
void describe(io::StudyVisitor& visitor, SurrogateParameters& parameters);

/// Parameters as the TOML that read_surrogate reads, exact and always in the same order: equal text means equal parameters.
std::string surrogate_text(const SurrogateParameters& parameters);

/// Reads voxel parameters, also those that earlier versions wrote. A table `[fit]`, in which a calibration reports how it found
/// them, is left unread, but for its status: of a file that is not "completed" the parameters are refused.
/// @throws io::InputError with file, key and value
SurrogateParameters read_surrogate(const std::filesystem::path& file);

}  // namespace menger::voxel
