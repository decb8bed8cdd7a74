#pragma once

#include <cstddef>
#include <string_view>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// Index of a boundary label. @throws io::InputError naming the label and those that the mesh has
std::size_t label_index(const HexahedralMesh& mesh, std::string_view label);

/// Index of a region. @throws io::InputError naming the region and those that the mesh has
std::size_t region_index(const HexahedralMesh& mesh, std::string_view region);

}  // namespace menger::meshes
