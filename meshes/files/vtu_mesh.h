#pragma once

#include <filesystem>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// Writes a mesh for ParaView (.vtu, compressed, double precision): its elements as hexahedra and its boundary as quadrilaterals.
/// The file is written whole or not at all.
///
/// Cell data: `region` (of elements, -1 on faces), `label` and `chamber` (of faces, -1 elsewhere). They are indices into the
/// field data `region_names`, `label_names` and `chamber_names`. Other field data hold what read_vtu_mesh needs to restore the
/// mesh: `plenum_names`, `chamber_plenums`, `chamber_labels` (chamber, label), `cap_rims` (chamber, cap, from, to) and
/// `geometry`.
/// @throws io::InputError if the file cannot be written
void write_vtu_mesh(const std::filesystem::path& file, const HexahedralMesh& mesh);

/// Reads a mesh that write_vtu_mesh wrote. The result equals the mesh that was written.
/// @throws io::InputError naming the file if it is missing, cannot be read, is not a mesh of this form, or has points that are
/// not finite, inverted elements, faces that are not the boundary, or an open chamber
HexahedralMesh read_vtu_mesh(const std::filesystem::path& file);

}  // namespace menger::meshes
