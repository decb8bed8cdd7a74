#include "meshes/hexahedra/mesh_counts.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace menger::meshes {
namespace {

std::size_t edge_count(const HexahedralMesh& mesh) {
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  edges.reserve(12 * mesh.elements.size());
  for (const ElementCorners& corners : mesh.elements) {
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      for (const std::size_t step : {1U, 2U, 4U})
        if ((corner & step) == 0U) edges.emplace_back(std::minmax(corners[corner], corners[corner | step]));
    }
  }
  std::sort(edges.begin(), edges.end());
  return static_cast<std::size_t>(std::unique(edges.begin(), edges.end()) - edges.begin());
}

}  // namespace

MeshCounts mesh_counts(const HexahedralMesh& mesh) {
  // Faces inside the solid belong to two elements, those of its boundary to one.
  return {.points = mesh.points.size(),
          .edges = edge_count(mesh),
          .faces = (6 * mesh.elements.size() + mesh.faces.size()) / 2,
          .elements = mesh.elements.size()};
}

MeshCounts refined(const MeshCounts& counts) {
  return {.points = counts.points + counts.edges + counts.faces + counts.elements,
          .edges = 2 * counts.edges + 4 * counts.faces + 6 * counts.elements,
          .faces = 4 * counts.faces + 12 * counts.elements,
          .elements = 8 * counts.elements};
}

}  // namespace menger::meshes
