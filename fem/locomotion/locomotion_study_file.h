#pragma once

#include <filesystem>
#include <string_view>

#include "fem/locomotion/locomotion_study.h"
#include "io/study/study_visitor.h"

namespace menger::fem {

/// The keys of a study of `menger locomote`, which `menger locomote --keys` lists. Texts have the design, the law and the points
/// of schedules themselves.
void describe(io::StudyVisitor& visitor, LocomotionStudy& study);

/// Reads a study of `menger locomote` and meshes its body.
/// @throws io::InputError with file, key and value for anything else, and for a body that cannot be hollowed out or meshed
LocomotionStudy read_locomotion_study(const std::filesystem::path& file);

/// The same from text that stands for that of the file.
LocomotionStudy parse_locomotion_study(std::string_view text, const std::filesystem::path& file);

}  // namespace menger::fem
