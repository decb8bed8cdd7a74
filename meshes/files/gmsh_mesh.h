#pragma once

#include <filesystem>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// Reads a mesh of Gmsh (.msh, all versions that the Gmsh library reads).
///
/// Names of physical volumes become regions ("wall" where there is none) and names of physical surfaces boundary labels ("outer"
/// where there is none; a physical group without a name is called by its number). Every surface whose name begins with "chamber"
/// is a chamber with a plenum of its own; it has to be closed, but for planes of symmetry: coordinate planes whose surfaces have
/// names that begin with "symmetry". Numbering for left-handed elements and faces that look the wrong way are repaired. Hexahedra
/// with 8 corners are read as they are; of those with 27 points the corners are kept, so that curved sides become straight.
/// @param length_unit_m metres per unit of the file, > 0; Gmsh's files do not say
/// @throws io::InputError naming the file and what is wrong: a file that is missing or no mesh, elements of another kind, and all
/// that assemble_mesh refuses
///
/// The Gmsh library keeps one global state, so only one thread may read at a time.
HexahedralMesh read_gmsh_mesh(const std::filesystem::path& file, double length_unit_m = 1.0);

}  // namespace menger::meshes
