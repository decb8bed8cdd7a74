#pragma once

#include <string>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// Refuses a mesh whose boundary faces are not its boundary: each side of an element that no other element shares has to be one
/// face, run around as BoundaryFace asks, and nothing else may be one.
/// @param source what messages begin with, such as the name of the file
/// @throws io::InputError naming the first such face, or how many are missing
void require_whole_boundary(const HexahedralMesh& mesh, const std::string& source);

}  // namespace menger::meshes
