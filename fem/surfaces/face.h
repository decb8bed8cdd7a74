#pragma once

#include <array>
#include <cstddef>

#include "fem/surfaces/point.h"

namespace menger::fem {

/// Positions of the nodes of a quadrilateral face, m: 4 of a bilinear face, 9 of a biquadratic one.
///
/// Node (i, j) lies at (u, v) = (i, j) / degree of the unit square and has the index i + (degree + 1) j; x_u x x_v points out of
/// the solid.
template <std::size_t n>
using FaceNodes = std::array<Point, n>;

/// The degree, in u and in v, of a face of n nodes.
template <std::size_t n>
inline constexpr std::size_t face_degree = n == 4 ? 1 : 2;

/// Returns the values at s of the Lagrange functions of degree 1 or 2 with equidistant nodes on [0, 1].
template <std::size_t degree>
constexpr std::array<double, degree + 1> shape_values(double s) {
  static_assert(degree == 1 || degree == 2);
  if constexpr (degree == 1) {
    return {1.0 - s, s};
  } else {
    return {(1.0 - s) * (1.0 - 2.0 * s), 4.0 * s * (1.0 - s), s * (2.0 * s - 1.0)};
  }
}

/// Returns the derivatives at s of the same Lagrange functions.
template <std::size_t degree>
constexpr std::array<double, degree + 1> shape_derivatives(double s) {
  static_assert(degree == 1 || degree == 2);
  if constexpr (degree == 1) {
    return {-1.0, 1.0};
  } else {
    return {4.0 * s - 3.0, 4.0 - 8.0 * s, 4.0 * s - 1.0};
  }
}

/// A point of Gauss's rule on [0, 1], with its weight.
struct QuadraturePoint {
  double position;
  double weight;
};

/// Returns Gauss's rule of 2, 3 or 4 points on [0, 1]; m points integrate polynomials of degree 2 m - 1 exactly.
template <std::size_t m>
constexpr std::array<QuadraturePoint, m> gauss_rule() {
  static_assert(m >= 2 && m <= 4);
  const auto pair = [](double abscissa, double weight) {  // on [-1, 1]
    return std::array<QuadraturePoint, 2>{{{0.5 - 0.5 * abscissa, 0.5 * weight}, {0.5 + 0.5 * abscissa, 0.5 * weight}}};
  };
  if constexpr (m == 2) {
    return pair(0.57735026918962576451, 1.0);
  } else if constexpr (m == 3) {
    const auto outer = pair(0.77459666924148337704, 5.0 / 9.0);
    return {outer[0], {0.5, 4.0 / 9.0}, outer[1]};
  } else {
    const auto outer = pair(0.86113631159405257522, 0.34785484513745385737);
    const auto inner = pair(0.33998104358485626480, 0.65214515486254614263);
    return {outer[0], inner[0], inner[1], outer[1]};
  }
}

}  // namespace menger::fem
