#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "fem/surfaces/point.h"

namespace menger::fem {

/// The place where two opposite parts of a chamber's surface are nearest to each other, or overlap most.
struct WallGap {
  /// Distance through the air, m, >= 0. If the walls cross, it is minus the depth of the crossing, measured along the mean of
  /// their normals.
  double gap_m;
  bool is_crossing;
  std::array<Point, 2> points;       ///< one on each wall
  std::array<std::size_t, 2> faces;  ///< their faces
};

/// Returns the smallest gap between parts of a chamber's surface that face each other, at the current positions of its nodes;
/// nothing if no two parts do.
///
/// Two parts face each other under two conditions: their normals (out of the solid) differ by more than 120 degrees, and the line
/// from one point to the other is within 45 degrees of the mean of the first normal and the reversed second one. Walls that meet
/// at a right angle do not face each other, nor do the two sides of a solid wall. Faces that share a corner are never compared:
/// in a wedge sharper than 60 degrees the reported gap is that of the second faces from its edge. In a round chamber the gap is
/// up to 14 % less than the diameter.
///
/// Walls cross if a point lies up to largest_depth_m behind an opposite wall. Deeper crossings are taken for the two sides of a
/// solid wall and not detected. Therefore largest_depth_m must be less than the thinnest solid wall, and more than walls move
/// between two calls. The deepest crossing is found to a relative accuracy of 1e-6.
///
/// Faces are cut into triangles between their nodes, 2 for a bilinear face and 8 for a biquadratic one. Where no two nodes are
/// opposite, the error of the gap is up to the sagitta of the triangles, h^2 / 8R each for edges h on a radius of curvature R.
/// Images behind planes of symmetry are not considered. A tree of boxes and cones of normals excludes most pairs of faces.
///
/// Defined for n = 4 and n = 9. Deterministic; positions must be finite.
/// @param faces node indices of each face, ordered as in FaceNodes @param largest_depth_m >= 0
/// @param largest_gap_m > 0; only smaller gaps are searched for. This saves time where very many parts are about equally far
/// apart, as in a sphere.
template <std::size_t n>
std::optional<WallGap> smallest_wall_gap(std::span<const std::array<std::size_t, n>> faces, std::span<const Point> nodes,
                                         double largest_depth_m, double largest_gap_m = std::numeric_limits<double>::infinity());

extern template std::optional<WallGap> smallest_wall_gap(std::span<const std::array<std::size_t, 4>>, std::span<const Point>,
                                                         double, double);
extern template std::optional<WallGap> smallest_wall_gap(std::span<const std::array<std::size_t, 9>>, std::span<const Point>,
                                                         double, double);

}  // namespace menger::fem
