#include "meshes/hexahedra/element_geometry.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "io/text/formatted.h"

namespace menger::meshes {
namespace {

const std::array<double, 2> gauss{0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};

Point reference_corner(std::size_t corner) {
  return {static_cast<double>(corner & 1U), static_cast<double>(corner >> 1U & 1U), static_cast<double>(corner >> 2U & 1U)};
}

Point gauss_point(std::size_t point) { return {gauss[point & 1U], gauss[point >> 1U & 1U], gauss[point >> 2U & 1U]}; }

double determinant(const std::array<Point, 3>& columns) { return dot(columns[0], cross(columns[1], columns[2])); }

double scaled_determinant(const std::array<Point, 3>& columns) {
  const double scale = length(columns[0]) * length(columns[1]) * length(columns[2]);
  return scale > 0.0 ? determinant(columns) / scale : -1.0;
}

}  // namespace

FaceCorners face_of_element(const ElementCorners& element, std::size_t side) {
  FaceCorners corners{};
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = element[face_corners[side][i]];
  return corners;
}

FaceCorners sorted(FaceCorners corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

double length(const Point& a) { return std::sqrt(dot(a, a)); }

double coincidence_tolerance_m(std::span<const Point> points) {
  assert(!points.empty());
  Point low = points.front();
  Point high = low;
  for (const Point& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  return 1e-6 * length(difference(high, low));
}

bool is_finite(const Point& place) { return std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2]); }

std::string millimetre_text(const Point& place) {
  return "(" + io::shown(1e3 * place[0], 6) + ", " + io::shown(1e3 * place[1], 6) + ", " + io::shown(1e3 * place[2], 6) + ") mm";
}

CornerPoints corner_points(const HexahedralMesh& mesh, std::size_t element) {
  CornerPoints corners{};
  for (std::size_t c = 0; c < corners.size(); ++c) corners[c] = mesh.points[mesh.elements[element][c]];
  return corners;
}

std::optional<Point> box_edges(const CornerPoints& corners) {
  constexpr double same = 1e-9;  // of the shortest edge
  const Point edges = difference(corners[7], corners[0]);
  const double shortest = std::min({edges[0], edges[1], edges[2]});
  if (!(shortest > 0.0)) return std::nullopt;
  for (std::size_t c = 0; c < 8; ++c) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double wanted = corners[0][i] + ((c >> i & 1U) != 0 ? edges[i] : 0.0);
      if (!(std::abs(corners[c][i] - wanted) <= same * shortest)) return std::nullopt;
    }
  }
  return edges;
}

std::array<Point, 3> jacobian(const CornerPoints& corners, const Point& xi) {
  std::array<Point, 3> columns{};
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Point at = reference_corner(c);
    Point weight{};
    Point sign{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      weight[axis] = at[axis] > 0.5 ? xi[axis] : 1.0 - xi[axis];
      sign[axis] = at[axis] > 0.5 ? 1.0 : -1.0;
    }
    const Point slope{sign[0] * weight[1] * weight[2], weight[0] * sign[1] * weight[2], weight[0] * weight[1] * sign[2]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < 3; ++i) columns[axis][i] += slope[axis] * corners[c][i];
    }
  }
  return columns;
}

double jacobian_determinant(const CornerPoints& corners, const Point& xi) { return determinant(jacobian(corners, xi)); }

double smallest_determinant(const CornerPoints& corners) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t point = 0; point < 8; ++point) {
    for (const Point& at : {reference_corner(point), gauss_point(point)}) {
      const double here = jacobian_determinant(corners, at);
      if (std::isnan(here)) return here;  // comparisons would not find NaN again
      smallest = std::min(smallest, here);
    }
  }
  return smallest;
}

double element_volume(const CornerPoints& corners) {
  double volume = 0.0;
  for (std::size_t point = 0; point < 8; ++point) volume += 0.125 * jacobian_determinant(corners, gauss_point(point));
  return volume;
}

double scaled_jacobian(const CornerPoints& corners) {
  double smallest = scaled_determinant(jacobian(corners, {0.5, 0.5, 0.5}));
  for (std::size_t corner = 0; corner < corners.size(); ++corner)
    smallest = std::min(smallest, scaled_determinant(jacobian(corners, reference_corner(corner))));
  return smallest;
}

std::pair<double, double> edge_range(const CornerPoints& corners) {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0.0;
  for (const auto& [a, b] : edge_corners) {
    const double edge = length(difference(corners[b], corners[a]));
    shortest = std::min(shortest, edge);
    longest = std::max(longest, edge);
  }
  return {shortest, longest};
}

double flux_of_position(const std::array<Point, 4>& corners) {
  double flux = 0.0;
  for (const double u : gauss) {
    for (const double v : gauss) {
      const std::array<double, 4> weight{(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v};
      Point x{};
      Point along_u{};
      Point along_v{};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t c = 0; c < 4; ++c) x[i] += weight[c] * corners[c][i];
        along_u[i] = (1.0 - v) * (corners[1][i] - corners[0][i]) + v * (corners[2][i] - corners[3][i]);
        along_v[i] = (1.0 - u) * (corners[3][i] - corners[0][i]) + u * (corners[2][i] - corners[1][i]);
      }
      flux += 0.25 * dot(x, cross(along_u, along_v));
    }
  }
  return flux;
}

}  // namespace menger::meshes
