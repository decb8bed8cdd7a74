#pragma once

#include <cstddef>
#include <string_view>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// Returns the index of a boundary label. @throws io::InputError naming the label and the labels of the mesh
std::size_t label_index(const HexahedralMesh& mesh, std::string_view label);

/// Returns the index of a region. @throws io::InputError naming the region and the regions of the mesh
std::size_t region_index(const HexahedralMesh& mesh, std::string_view region);

}  // namespace menger::meshes
