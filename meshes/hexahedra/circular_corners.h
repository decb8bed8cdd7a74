#pragma once

#include <array>
#include <cstddef>

namespace menger::meshes {

/// Converts the corners of a hexahedron of VTK or Gmsh to ElementCorners: for each corner its position there. VTK and Gmsh number
/// the corners around the bottom and then around the top.
inline constexpr std::array<std::size_t, 8> corner_of_circular{0, 1, 3, 2, 4, 5, 7, 6};

}  // namespace menger::meshes
