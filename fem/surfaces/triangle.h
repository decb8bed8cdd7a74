#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "fem/surfaces/point.h"

namespace menger::fem {

/// A flat triangle of a wall. Its corners are ordered around the normal, which points into the air.
struct Triangle {
  std::array<Point, 3> corners;
  Point normal;  ///< of length 1, or zero for a triangle without area
};

inline Triangle triangle(const Point& a, const Point& b, const Point& c) {
  const Point area = cross(difference(b, a), difference(c, a));
  const double length = norm(area);
  return {{a, b, c}, length > 0.0 ? scaled(1.0 / length, area) : Point{}};
}

/// Returns the foot of the perpendicular from a point to the plane of a triangle; nothing if it lies outside the triangle.
inline std::optional<Point> foot_within(const Triangle& triangle, const Point& point) {
  const double height = dot(difference(point, triangle.corners[0]), triangle.normal);
  const Point foot = difference(point, scaled(height, triangle.normal));
  for (std::size_t a = 0; a < 3; ++a) {
    const Point& from = triangle.corners[a];
    const Point edge = difference(triangle.corners[(a + 1) % 3], from);
    if (dot(cross(edge, difference(foot, from)), triangle.normal) < 0.0) return std::nullopt;
  }
  return foot;
}

/// Returns the nearest points of two segments, ends included; for parallel segments one of several nearest pairs.
inline std::array<Point, 2> nearest_points(const Point& a0, const Point& a1, const Point& b0, const Point& b1) {
  const Point along_a = difference(a1, a0);
  const Point along_b = difference(b1, b0);
  const Point between = difference(a0, b0);
  const double aa = dot(along_a, along_a);
  const double bb = dot(along_b, along_b);
  const double ab = dot(along_a, along_b);
  const double a_between = dot(along_a, between);
  const double b_between = dot(along_b, between);
  const auto clamped = [](double s) { return std::clamp(s, 0.0, 1.0); };
  // First the nearest points of the two lines. If the one on b lies outside segment b, take b's end and the point of a nearest to
  // it.
  const double determinant = aa * bb - ab * ab;
  double s = determinant > 0.0 ? clamped((ab * b_between - a_between * bb) / determinant) : 0.0;
  const double line_t = bb > 0.0 ? (ab * s + b_between) / bb : 0.0;
  const double t = clamped(line_t);
  if (t != line_t) s = aa > 0.0 ? clamped((ab * t - a_between) / aa) : 0.0;
  return {sum(a0, scaled(s, along_a)), sum(b0, scaled(t, along_b))};
}

/// Calls consider(x, y) for pairs of a point x of the first and y of the second triangle: the nearest points of a corner and the
/// other face, and of two edges. If the triangles do not intersect, their nearest pair is among them.
template <class Consider>
void for_each_near_pair(const Triangle& first, const Triangle& second, const Consider& consider) {
  for (const Point& corner : first.corners)
    if (const auto foot = foot_within(second, corner)) consider(corner, *foot);
  for (const Point& corner : second.corners)
    if (const auto foot = foot_within(first, corner)) consider(*foot, corner);
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      const auto [x, y] =
          nearest_points(first.corners[a], first.corners[(a + 1) % 3], second.corners[b], second.corners[(b + 1) % 3]);
      consider(x, y);
    }
  }
}

}  // namespace menger::fem
