#pragma once

#include <filesystem>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// Reads a mesh of Gmsh (.msh, all versions that the Gmsh library reads).
///
/// Names of physical volumes become regions; a volume without a name is "wall". Names of physical surfaces become boundary
/// labels; a surface without a name is "outer". A physical group without a name is called by its number.
///
/// Every surface whose name begins with "chamber" is a chamber with a plenum of its own. It must be closed. A surface whose name
/// begins with "cap" is a cap that closes a chamber. A chamber may also end at planes of symmetry: coordinate planes whose
/// surfaces have names that begin with "symmetry".
///
/// Left-handed numbering of elements and faces with the wrong orientation are repaired. Hexahedra with 8 corners are read
/// unchanged. Of those with 27 points only the corners are kept, so curved sides become straight.
/// @param length_unit_m metres per unit of the file, > 0; files of Gmsh do not state their unit
/// @throws io::InputError naming the file and the fault: a file that is missing or not a mesh, elements of another kind, and
/// everything that assemble_mesh refuses
///
/// The Gmsh library has one global state, so only one thread may read at a time.
HexahedralMesh read_gmsh_mesh(const std::filesystem::path& file, double length_unit_m = 1.0);

}  // namespace menger::meshes
