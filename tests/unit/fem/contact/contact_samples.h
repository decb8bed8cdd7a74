#pragma once

#include <cstddef>
#include <vector>

#include "fem/contact/self_contact.h"
#include "meshes/hexahedra/grid_mesh.h"
#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {

/// A body of cubes of an edge: those cells of a grid that is_solid(i, j, k) picks. One region "wall", one label "outer".
template <class IsSolid>
meshes::HexahedralMesh body_of_cubes(const meshes::GridIndex& size, double edge_m, const IsSolid& is_solid) {
  meshes::MeshGrid grid;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t n = 0; n <= size[axis]; ++n) grid.lines[axis].push_back(edge_m * static_cast<double>(n));
  for (std::size_t k = 0; k < size[2]; ++k)
    for (std::size_t j = 0; j < size[1]; ++j)
      for (std::size_t i = 0; i < size[0]; ++i)
        grid.contents.push_back(is_solid(i, j, k) ? meshes::GridContent::solid(0) : meshes::GridContent::air(0));
  meshes::HexahedralMesh mesh;
  mesh.region_names = {"wall"};
  mesh.label_names = {"outer"};
  meshes::fill_from_grid(mesh, grid, {});
  return mesh;
}

/// A U in the plane x, z, in cubes of 2 mm: a base of 5 x 2 x 1 and legs of 2 x 2 x 6 with 2 mm of air between them.
inline meshes::HexahedralMesh u_body() {
  return body_of_cubes({5, 2, 7}, 2e-3, [](std::size_t i, std::size_t, std::size_t k) { return k == 0 || i != 2; });
}

/// Two blocks of 4 x 4 x 2 cubes of 2 mm, one above the other, 4 mm apart, joined by a bow of single cubes beside them.
inline meshes::HexahedralMesh two_blocks() {
  return body_of_cubes({6, 4, 6}, 2e-3, [](std::size_t i, std::size_t j, std::size_t k) {
    const bool is_block = i < 4 && (k < 2 || k >= 4);
    const bool is_bow = j == 0 && (i == 5 || (i == 4 && (k == 0 || k == 5)));
    return is_block || is_bow;
  });
}

/// Positions of a mesh's nodes after a map, 3 per node.
template <class Map>
std::vector<double> mapped(const meshes::HexahedralMesh& mesh, const Map& map) {
  std::vector<double> positions;
  for (const Point& point : mesh.points) {
    const Point at = map(point);
    positions.insert(positions.end(), at.begin(), at.end());
  }
  return positions;
}

}  // namespace menger::fem
