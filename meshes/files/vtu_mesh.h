#pragma once

#include <filesystem>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// Writes a mesh for ParaView (.vtu, compressed, double precision): its elements as hexahedra and its boundary as quadrilaterals.
///
/// Cell data: `region` (of elements, -1 on faces), `label` and `chamber` (of faces, -1 elsewhere), all indices into the field
/// data `region_names`, `label_names` and `chamber_names`. Further field data keep what read_vtu_mesh needs to give the mesh
/// back: `plenum_names`, `chamber_plenums`, `chamber_labels` (chamber, label), `cap_rims` (chamber, cap, from, to) and
/// `geometry`. Whole or not at all. @throws io::InputError if the place cannot be written
void write_vtu_mesh(const std::filesystem::path& file, const HexahedralMesh& mesh);

/// The mesh of such a file, equal to the one written.
/// @throws io::InputError naming the file if it is missing, cannot be read, is no mesh of this form, has points that are no
/// finite numbers, inverted elements, faces that are not its boundary or an open chamber
HexahedralMesh read_vtu_mesh(const std::filesystem::path& file);

}  // namespace menger::meshes
