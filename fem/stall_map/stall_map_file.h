#pragma once

#include <filesystem>

#include "fem/stall_map/stall_map.h"
#include "io/study/study_visitor.h"

namespace menger::fem {

/// Describes the keys of a study of `menger stall-map`, which `menger stall-map --keys` lists. The text of a study contains the
/// plenum's curve and the design, instead of the files that they came from.
void describe(io::StudyVisitor& visitor, StallMapStudy& study);

/// Reads a study of `menger stall-map`.
/// @throws io::InputError with file, key and value for values outside their ranges, strokes beyond the cylinder or without room
/// for air, fill pressures outside the curve, and marks at frequencies that are not on the map
StallMapStudy read_stall_map_study(const std::filesystem::path& file);

}  // namespace menger::fem
