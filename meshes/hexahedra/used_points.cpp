#include "meshes/hexahedra/used_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "io/text/input_error.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::meshes {
namespace {

/// Whether an edge lies in a plane of symmetry, which bounds a cap without any edge of an element.
bool in_coordinate_plane(const Point& a, const Point& b) {
  const double tolerance = 1e-6 * length(difference(b, a));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::max(std::abs(a[axis]), std::abs(b[axis])) <= tolerance) return true;
  }
  return false;
}

}  // namespace

void drop_unused_points(NamedHexahedra& input, const std::string& source) {
  constexpr std::size_t unused = SIZE_MAX;
  std::vector<std::size_t> kept(input.points.size(), unused);
  std::vector<Point> points;
  for (ElementCorners& element : input.elements) {
    for (std::size_t& corner : element) {
      if (kept[corner] == unused) {
        kept[corner] = points.size();
        points.push_back(input.points[corner]);
      }
      corner = kept[corner];
    }
  }
  for (NamedFace& face : input.faces) {
    for (std::size_t& corner : face.corners) {
      if (kept[corner] == unused)
        throw io::InputError(source + ": \"" + input.label_names[face.label] + "\" has points of no hexahedron");
      corner = kept[corner];
    }
  }
  for (NamedCap& cap : input.caps) {
    std::erase_if(cap.rim, [&](const std::array<std::size_t, 2>& edge) {
      if (kept[edge[0]] != unused && kept[edge[1]] != unused) return false;
      if (in_coordinate_plane(input.points[edge[0]], input.points[edge[1]])) return true;
      throw io::InputError(source + ": the rim of \"" + cap.name + "\" has points of no hexahedron");
    });
    for (std::array<std::size_t, 2>& edge : cap.rim) edge = {kept[edge[0]], kept[edge[1]]};
  }
  input.points = std::move(points);
}

}  // namespace menger::meshes
