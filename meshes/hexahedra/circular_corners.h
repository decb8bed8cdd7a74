#pragma once

#include <array>
#include <cstddef>

namespace menger::meshes {

/// For each corner of a hexahedron of VTK and of Gmsh, both of which run around the bottom and then around the top, its place in
/// ElementCorners.
inline constexpr std::array<std::size_t, 8> corner_of_circular{0, 1, 3, 2, 4, 5, 7, 6};

}  // namespace menger::meshes
