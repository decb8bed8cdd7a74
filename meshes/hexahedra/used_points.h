#pragma once

#include <string>

#include "meshes/hexahedra/mesh_assembly.h"

namespace menger::meshes {

/// Leaves only the points of elements, numbered in the order in which elements use them: other programs keep those of curves, of
/// unused surfaces and in the middle of edges. Edges of caps that lie in a plane of symmetry and not on the solid are dropped,
/// too.
/// @param source what messages begin with, such as the name of the file
/// @throws io::InputError if a named face or any other edge of a cap has a point of no element
void drop_unused_points(NamedHexahedra& input, const std::string& source);

}  // namespace menger::meshes
