#pragma once

#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/design/modular_body.h"

namespace menger::meshes {

/// Checks that a design can be made hollow. Refused are options outside their range, walls of half a cell or more, cells that are
/// not all joined by whole faces, and cells that touch only along an edge or at a corner (a casting would break there).
/// @throws io::InputError naming design, option or cells, and value
void check_design(const Design& design, const HollowBodyOptions& options);

/// Refuses an aggregate that is not connected, and tube holes that do not lead from a chamber through an outer wall.
/// @throws io::InputError naming design, option or cells, and value
void check_body(const Design& design, const HollowBodyOptions& options, const ModularBody& body);

}  // namespace menger::meshes
