#pragma once

#include <filesystem>

#include "fem/stall_map/stall_map.h"
#include "io/study/study_visitor.h"

namespace menger::fem {

/// The keys of a study of `menger stall-map`, which `menger stall-map --keys` lists. Texts have the plenum's curve and the design
/// themselves.
void describe(io::StudyVisitor& visitor, StallMapStudy& study);

/// Reads a study of `menger stall-map`.
/// @throws io::InputError with file, key and value for what lies outside its range, strokes beyond the cylinder or without room
/// for air, fill pressures outside the curve, and marks at frequencies that are not on the map
StallMapStudy read_stall_map_study(const std::filesystem::path& file);

}  // namespace menger::fem
