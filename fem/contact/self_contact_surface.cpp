#include "fem/contact/self_contact_surface.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace menger::fem {
double shortest_edge_m(const meshes::HexahedralMesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const meshes::ElementCorners& element : mesh.elements) {
    for (std::size_t c = 0; c < 8; ++c) {
      for (const std::size_t bit : {1U, 2U, 4U}) {
        if ((c & bit) != 0) continue;
        shortest = std::min(shortest, norm(difference(mesh.points[element[c | bit]], mesh.points[element[c]])));
      }
    }
  }
  return shortest;
}

ContactSurfaces::ContactSurfaces(const meshes::HexahedralMesh& mesh, bool with_outside)
    : shortest_edge_(fem::shortest_edge_m(mesh)) {
  std::vector<std::size_t> surface_of_label(mesh.label_names.size(), 0);
  for (std::size_t c = 0; c < mesh.chambers.size(); ++c)
    for (const std::size_t label : mesh.chambers[c].labels) surface_of_label[label] = c + 1;
  std::vector<std::vector<std::size_t>> boundary_faces(mesh.chambers.size() + 1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) boundary_faces[surface_of_label[mesh.faces[f].label]].push_back(f);
  if (!with_outside) boundary_faces[0].clear();
  for (const auto& faces : boundary_faces) add_surface(mesh, faces);
  set_areas(mesh);
  set_faces_around();
  set_elements_behind(mesh);
}

void ContactSurfaces::add_surface(const meshes::HexahedralMesh& mesh, const std::vector<std::size_t>& boundary_faces) {
  const std::size_t first = nodes_.size();
  for (const std::size_t f : boundary_faces)
    for (const std::size_t node : mesh.faces[f].corners) nodes_.push_back(static_cast<std::uint32_t>(node));
  const auto begin = nodes_.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, nodes_.end());
  nodes_.erase(std::unique(begin, nodes_.end()), nodes_.end());
  for (const std::size_t f : boundary_faces) {
    auto& face = faces_.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) {
      const auto node = static_cast<std::uint32_t>(mesh.faces[f].corners[c]);
      const auto found = std::lower_bound(nodes_.begin() + static_cast<std::ptrdiff_t>(first), nodes_.end(), node);
      face[c] = static_cast<std::uint32_t>(found - nodes_.begin());
    }
  }
  surfaces_.resize(nodes_.size(), static_cast<std::uint32_t>(surface_faces_.size() - 1));
  surface_faces_.push_back(static_cast<std::uint32_t>(faces_.size()));
}

void ContactSurfaces::set_areas(const meshes::HexahedralMesh& mesh) {
  areas_.assign(nodes_.size(), 0.0);
  for (const auto& face : faces_) {
    FaceCorners at;
    for (std::size_t c = 0; c < 4; ++c) at[c] = mesh.points[nodes_[face[c]]];
    for (const std::uint32_t node : face) areas_[node] += 0.25 * norm(area_vector(at));
  }
}

void ContactSurfaces::set_faces_around() {
  around_offsets_.assign(nodes_.size() + 1, 0);
  for (const auto& face : faces_)
    for (const std::uint32_t node : face) ++around_offsets_[node + 1];
  for (std::size_t n = 0; n < nodes_.size(); ++n) around_offsets_[n + 1] += around_offsets_[n];
  around_.resize(4 * faces_.size());
  std::vector<std::uint32_t> next(around_offsets_.begin(), around_offsets_.end() - 1);
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (const std::uint32_t node : faces_[f]) around_[next[node]++] = static_cast<std::uint32_t>(f);
}

void ContactSurfaces::set_elements_behind(const meshes::HexahedralMesh& mesh) {
  elements_at_.resize(mesh.points.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    auto& corners = elements_.emplace_back();
    for (std::size_t c = 0; c < 8; ++c) {
      corners[c] = static_cast<std::uint32_t>(mesh.elements[e][c]);
      elements_at_[corners[c]].push_back(static_cast<std::uint32_t>(e));
    }
  }
  for (const auto& face : faces_) {
    const auto& candidates = elements_at_[nodes_[face[0]]];
    const auto found = std::find_if(candidates.begin(), candidates.end(), [&](std::uint32_t e) {
      const auto& corners = elements_[e];
      return std::all_of(face.begin(), face.end(), [&](std::uint32_t node) {
        return std::find(corners.begin(), corners.end(), nodes_[node]) != corners.end();
      });
    });
    assert(found != candidates.end());
    element_behind_.push_back(*found);
  }
}

bool ContactSurfaces::is_of_element_behind(std::size_t node, std::size_t face) const {
  const auto& corners = elements_[element_behind_[face]];
  return std::find(corners.begin(), corners.end(), nodes_[node]) != corners.end();
}

bool ContactSurfaces::are_of_one_element(std::size_t node, std::size_t other, std::size_t third) const {
  const auto& elements = elements_at_[nodes_[node]];
  return std::any_of(elements.begin(), elements.end(), [&](std::uint32_t element) {
    const auto& corners = elements_[element];
    return std::find(corners.begin(), corners.end(), nodes_[other]) != corners.end() &&
           std::find(corners.begin(), corners.end(), nodes_[third]) != corners.end();
  });
}

std::vector<Point> ContactSurfaces::points(std::span<const double> positions_m) const {
  std::vector<Point> result(nodes_.size());
  for (std::size_t n = 0; n < nodes_.size(); ++n) result[n] = point(n, positions_m);
  return result;
}

}  // namespace menger::fem
