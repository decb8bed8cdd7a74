#pragma once

#include <filesystem>
#include <optional>

#include "io/study/study_visitor.h"
#include "io/text/toml_document.h"
#include "voxel/model/calibrated_body.h"

namespace menger::voxel {

/// Describes the keys of a table `[surrogate]`: the parameters, from a file or in the table itself, and how they are used.
/// Written texts have the parameters themselves. The pressures are among the keys of the drive. When read, parameters of another
/// silicone or wall thickness than the table gives are refused.
void describe(io::StudyVisitor& visitor, CalibratedBody& body);

/// The file of parameters that `[surrogate]` names; nothing if it names none.
/// @param table of a scene or study @throws io::InputError with file, key and value
std::optional<std::filesystem::path> parameters_file(const io::TomlTable& table);

}  // namespace menger::voxel
