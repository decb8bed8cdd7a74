#pragma once

#include <cstddef>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// How many points, edges, faces and elements a mesh has. What several elements share counts once.
struct MeshCounts {
  std::size_t points = 0;
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t elements = 0;

  /// Returns the nodes of elements of a degree: points; for degree 2 one more in the middle of each edge, face and element.
  /// @param degree 1 or 2
  [[nodiscard]] std::size_t nodes(int degree) const { return degree == 1 ? points : points + edges + faces + elements; }
};

MeshCounts mesh_counts(const HexahedralMesh& mesh);

/// Returns the counts after each element was split into eight.
MeshCounts refined(const MeshCounts& counts);

}  // namespace menger::meshes
