#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fem/contact/self_contact_face.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// The shortest edge of a mesh's elements in the reference configuration, m.
double shortest_edge_m(const meshes::HexahedralMesh& mesh);

/// The surfaces of a body whose parts can meet through the air: the outside and the walls of each chamber. Nodes and faces are
/// numbered over all surfaces, one surface after the other. A node of the mesh that lies on two surfaces has two numbers.
class ContactSurfaces {
 public:
  /// Collects the surfaces of a mesh that may touch. Surface 0 is the outside, surface c + 1 the wall of chamber c.
  /// @param with_outside false leaves surface 0 empty
  explicit ContactSurfaces(const meshes::HexahedralMesh& mesh, bool with_outside = true);

  [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }
  [[nodiscard]] std::size_t face_count() const { return faces_.size(); }
  [[nodiscard]] std::size_t surface_count() const { return surface_faces_.size() - 1; }
  /// The index of the first face of each surface, and the number of faces at the end: surface_count() + 1 numbers.
  [[nodiscard]] const std::vector<std::uint32_t>& surface_faces() const { return surface_faces_; }

  [[nodiscard]] std::uint32_t mesh_node(std::size_t node) const { return nodes_[node]; }
  [[nodiscard]] std::size_t surface(std::size_t node) const { return surfaces_[node]; }
  /// The area of a node in the reference configuration, m^2: a quarter of each face of its surface at the node.
  [[nodiscard]] double area_m2(std::size_t node) const { return areas_[node]; }
  [[nodiscard]] const std::array<std::uint32_t, 4>& face(std::size_t face) const { return faces_[face]; }
  [[nodiscard]] std::span<const std::uint32_t> faces_around(std::size_t node) const {
    return std::span(around_).subspan(around_offsets_[node], around_offsets_[node + 1] - around_offsets_[node]);
  }

  /// Whether a node is a corner of the element behind a face. Such a node can reach the face only if the element turns inside
  /// out.
  [[nodiscard]] bool is_of_element_behind(std::size_t node, std::size_t face) const;

  /// Whether one element contains all three nodes, two of which may be the same.
  [[nodiscard]] bool are_of_one_element(std::size_t node, std::size_t other, std::size_t third) const;

  /// The shortest edge of the elements in the reference configuration, m.
  [[nodiscard]] double shortest_edge_m() const { return shortest_edge_; }

  /// The position of one node, or of all nodes. @param positions_m of the mesh's nodes, 3 per node
  [[nodiscard]] Point point(std::size_t node, std::span<const double> positions_m) const {
    const std::size_t first = 3 * std::size_t{nodes_[node]};
    return {positions_m[first], positions_m[first + 1], positions_m[first + 2]};
  }
  [[nodiscard]] std::vector<Point> points(std::span<const double> positions_m) const;
  [[nodiscard]] FaceCorners corners(std::size_t face, std::span<const Point> points) const {
    const auto& [a, b, c, d] = faces_[face];
    return {points[a], points[b], points[c], points[d]};
  }

 private:
  void add_surface(const meshes::HexahedralMesh& mesh, const std::vector<std::size_t>& boundary_faces);
  void set_areas(const meshes::HexahedralMesh& mesh);
  void set_faces_around();
  void set_elements_behind(const meshes::HexahedralMesh& mesh);

  std::vector<std::uint32_t> nodes_;
  std::vector<std::uint32_t> surfaces_;
  std::vector<double> areas_;
  std::vector<std::array<std::uint32_t, 4>> faces_;
  std::vector<std::uint32_t> surface_faces_{0};
  std::vector<std::uint32_t> element_behind_;            // of each face
  std::vector<std::array<std::uint32_t, 8>> elements_;   // nodes of the mesh
  std::vector<std::vector<std::uint32_t>> elements_at_;  // of each node of the mesh
  std::vector<std::uint32_t> around_offsets_;
  std::vector<std::uint32_t> around_;
  double shortest_edge_;
};

}  // namespace menger::fem
