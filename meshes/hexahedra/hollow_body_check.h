#pragma once

#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/design/modular_body.h"

namespace menger::meshes {

/// Refuses what cannot be hollowed out: options outside their range, a wall that is not thinner than half a cell, a design that
/// is not face-connected or whose cells touch only along an edge or at a corner (it would not survive casting).
/// @throws io::InputError naming design, option or cells, and value
void check_design(const Design& design, const HollowBodyOptions& options);

/// Refuses an aggregate that falls apart and tube holes that do not lead from a chamber through an outer wall.
/// @throws io::InputError naming design, option or cells, and value
void check_body(const Design& design, const HollowBodyOptions& options, const ModularBody& body);

}  // namespace menger::meshes
