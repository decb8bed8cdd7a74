#pragma once

#include <filesystem>
#include <optional>

#include "io/study/study_visitor.h"
#include "io/text/toml_document.h"
#include "voxel/model/calibrated_body.h"

namespace menger::voxel {

/// The keys of a table `[surrogate]`: the parameters, from a file or in the table itself, and what becomes of them. Texts have
/// the parameters themselves. The pressures stand with the drive. A reader refuses parameters of another silicone or wall
/// thickness than the table says.
void describe(io::StudyVisitor& visitor, CalibratedBody& body);

/// The file that `[surrogate]` takes its parameters from, if it names one.
/// @param table of a scene or study @throws io::InputError with file, key and value
std::optional<std::filesystem::path> parameters_file(const io::TomlTable& table);

}  // namespace menger::voxel
