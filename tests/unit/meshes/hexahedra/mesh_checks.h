#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "meshes/hexahedra/element_geometry.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

using FaceKey = std::array<std::size_t, 4>;

inline FaceKey sorted(FaceKey corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

inline double solid_volume(const HexahedralMesh& mesh) {
  double volume = 0.0;
  for (std::size_t element = 0; element < mesh.elements.size(); ++element) volume += element_volume(corner_points(mesh, element));
  return volume;
}

/// Area vector of a face, by its diagonals.
inline Point area_vector(const HexahedralMesh& mesh, const BoundaryFace& face) {
  const auto& c = face.corners;
  const Point area = cross(difference(mesh.points[c[2]], mesh.points[c[0]]), difference(mesh.points[c[3]], mesh.points[c[1]]));
  return {0.5 * area[0], 0.5 * area[1], 0.5 * area[2]};
}

/// Area of all faces with a label.
inline double label_area(const HexahedralMesh& mesh, std::string_view label) {
  double area = 0.0;
  for (const BoundaryFace& face : mesh.faces) {
    if (mesh.label_names[face.label] == label) area += length(area_vector(mesh, face));
  }
  return area;
}

/// Every face of an element belongs to one other element or is listed once as boundary; the boundary looks out of the solid;
/// every point is used; the boundary's flux of position gives the volume of the solid.
inline void expect_sound(const HexahedralMesh& mesh) {
  std::map<FaceKey, int> uses;
  std::vector<bool> used(mesh.points.size(), false);
  for (const ElementCorners& corners : mesh.elements) {
    for (const std::size_t corner : corners) used[corner] = true;
    for (const auto& face : face_corners)
      ++uses[sorted({corners[face[0]], corners[face[1]], corners[face[2]], corners[face[3]]})];
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0) << "points of no element";
  double flux = 0.0;
  std::size_t boundary = 0;
  for (const BoundaryFace& face : mesh.faces) {
    ASSERT_EQ(uses[sorted(face.corners)], 1) << "a boundary face that is none, or is listed twice";
    uses[sorted(face.corners)] = -1;
    ASSERT_LT(face.label, mesh.label_names.size());
    flux += flux_of_position(
        {mesh.points[face.corners[0]], mesh.points[face.corners[1]], mesh.points[face.corners[2]], mesh.points[face.corners[3]]});
    ++boundary;
  }
  for (const auto& [face, count] : uses) ASSERT_TRUE(count == 2 || count == -1) << "a face of " << count << " elements";
  ASSERT_EQ(mesh.regions.size(), mesh.elements.size());
  for (const std::size_t region : mesh.regions) ASSERT_LT(region, mesh.region_names.size());
  const double volume = solid_volume(mesh);
  // Both sums have some 1e5 terms of either sign: a few thousand roundings.
  EXPECT_NEAR(flux / 3.0, volume, 1e-11 * volume) << boundary << " faces";
}

}  // namespace menger::meshes
