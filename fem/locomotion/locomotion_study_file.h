#pragma once

#include <filesystem>
#include <string_view>

#include "fem/locomotion/locomotion_study.h"
#include "io/study/study_visitor.h"

namespace menger::fem {

/// Describes the keys of a study of `menger locomote`, which `menger locomote --keys` lists. The text of a study contains its
/// design, its law and the points of its schedules, instead of the files that they came from.
void describe(io::StudyVisitor& visitor, LocomotionStudy& study);

/// Reads a study of `menger locomote` and meshes its body.
/// @throws io::InputError with file, key and value for wrong input, and for a body that cannot be hollowed out or meshed
LocomotionStudy read_locomotion_study(const std::filesystem::path& file);

/// Does the same with a text that replaces the content of the file.
LocomotionStudy parse_locomotion_study(std::string_view text, const std::filesystem::path& file);

}  // namespace menger::fem
