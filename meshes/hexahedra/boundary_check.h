#pragma once

#include <string>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// Checks that the boundary faces of a mesh are exactly its boundary. Each side of an element that belongs to no other element
/// must be one face, with the orientation that BoundaryFace requires. Nothing else may be a face.
/// @param source text at the start of messages, such as the name of the file
/// @throws io::InputError naming the first wrong face, or the number of missing faces
void require_whole_boundary(const HexahedralMesh& mesh, const std::string& source);

}  // namespace menger::meshes
