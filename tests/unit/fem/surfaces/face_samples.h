#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "fem/surfaces/face.h"

namespace menger::fem {

/// Faces over shared nodes.
template <std::size_t n>
struct SampleSurface {
  std::vector<Point> nodes;
  std::vector<std::array<std::size_t, n>> faces;

  [[nodiscard]] FaceNodes<n> positions(std::size_t face) const {
    FaceNodes<n> result;
    for (std::size_t a = 0; a < n; ++a) result[a] = nodes[faces[face][a]];
    return result;
  }

  template <class Map>
  void deform(const Map& map) {
    for (Point& node : nodes) node = map(node);
  }
};

/// Adds the rectangle corner + s along_u + t along_v, s and t in [0, 1], of cells_u x cells_v faces; nodes at equal positions are
/// shared. The normal is along_u x along_v.
template <std::size_t n>
void add_rectangle(SampleSurface<n>& surface, const Point& corner, const Point& along_u, const Point& along_v,
                   std::size_t cells_u, std::size_t cells_v) {
  constexpr std::size_t degree = face_degree<n>;
  std::map<std::array<long, 3>, std::size_t> known;
  const auto key = [](const Point& p) {
    return std::array<long, 3>{std::lround(p[0] * 1e9), std::lround(p[1] * 1e9), std::lround(p[2] * 1e9)};
  };
  for (std::size_t a = 0; a < surface.nodes.size(); ++a) known.emplace(key(surface.nodes[a]), a);
  const auto node = [&](std::size_t i, std::size_t j) {
    const double s = static_cast<double>(i) / static_cast<double>(degree * cells_u);
    const double t = static_cast<double>(j) / static_cast<double>(degree * cells_v);
    const Point p = sum(corner, sum(scaled(s, along_u), scaled(t, along_v)));
    const auto [place, is_new] = known.emplace(key(p), surface.nodes.size());
    if (is_new) surface.nodes.push_back(p);
    return place->second;
  };
  for (std::size_t v = 0; v < cells_v; ++v) {
    for (std::size_t u = 0; u < cells_u; ++u) {
      std::array<std::size_t, n> face{};
      for (std::size_t a = 0; a < n; ++a) face[a] = node(degree * u + a % (degree + 1), degree * v + a / (degree + 1));
      surface.faces.push_back(face);
    }
  }
}

/// The walls of a box-shaped chamber from low to low + size with normals into the air, of cells x cells faces each.
/// @param has_top whether the wall at the largest z is there
template <std::size_t n>
SampleSurface<n> box_chamber(const Point& low, const Point& size, std::size_t cells, bool has_top = true) {
  const Point x{size[0], 0.0, 0.0};
  const Point y{0.0, size[1], 0.0};
  const Point z{0.0, 0.0, size[2]};
  SampleSurface<n> surface;
  add_rectangle(surface, low, x, y, cells, cells);
  if (has_top) add_rectangle(surface, sum(low, z), y, x, cells, cells);
  add_rectangle(surface, low, y, z, cells, cells);
  add_rectangle(surface, sum(low, x), z, y, cells, cells);
  add_rectangle(surface, low, z, x, cells, cells);
  add_rectangle(surface, sum(low, y), x, z, cells, cells);
  return surface;
}

/// A smooth map without symmetry that bends faces; its Jacobian is positive for positions of up to about 1.
inline Point bent(const Point& p) {
  return {p[0] + 0.2 * p[1] * p[2] + 0.1 * std::sin(2.0 * p[1]), 1.2 * p[1] + 0.15 * p[0] * p[0] - 0.1 * p[2],
          0.9 * p[2] + 0.1 * p[0] * p[1] + 0.1 * std::cos(p[0])};
}

}  // namespace menger::fem
