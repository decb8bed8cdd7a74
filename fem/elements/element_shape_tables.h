#pragma once

#include <array>
#include <cstddef>

namespace menger::fem {

/// Tables of the shape functions of the Lagrange hexahedron of a degree, at the points of its Gauss rule on the reference cube
/// [-1, 1]^3.
template <int degree>
struct ElementShapeTables {
  static constexpr std::size_t side = degree + 1;
  static constexpr std::size_t nodes = side * side * side;
  static constexpr std::size_t points = nodes;
  static constexpr std::size_t modes = degree == 1 ? 1 : 4;
  static constexpr std::size_t pairs = nodes * (nodes + 1) / 2;

  std::array<double, points> weight{};
  std::array<std::array<std::array<double, 3>, nodes>, points> gradient{};  ///< derivatives by the reference coordinates
  std::array<std::array<double, nodes>, points> value{};
  std::array<std::array<double, modes>, points> mode{};
};

namespace detail {

/// Points and weights of the Gauss rule with one point more than the degree.
template <int degree>
struct GaussRule;
template <>
struct GaussRule<1> {
  static constexpr double x = 0.57735026918962576451;  // 1/sqrt(3)
  static constexpr std::array<double, 2> point{-x, x};
  static constexpr std::array<double, 2> weight{1.0, 1.0};
};
template <>
struct GaussRule<2> {
  static constexpr double x = 0.77459666924148337704;  // sqrt(3/5)
  static constexpr std::array<double, 3> point{-x, 0.0, x};
  static constexpr std::array<double, 3> weight{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
};

/// Value and slope of the Lagrange polynomials of equidistant nodes on [-1, 1].
template <int degree>
constexpr std::array<std::array<double, 2>, static_cast<std::size_t>(degree) + 1> lagrange(double x) {
  if constexpr (degree == 1) {
    return {{{0.5 * (1.0 - x), -0.5}, {0.5 * (1.0 + x), 0.5}}};
  } else {
    return {{{0.5 * x * (x - 1.0), x - 0.5}, {(1.0 - x) * (1.0 + x), -2.0 * x}, {0.5 * x * (x + 1.0), x + 0.5}}};
  }
}

}  // namespace detail

template <int degree>
constexpr ElementShapeTables<degree> element_shape_tables() {
  using Tables = ElementShapeTables<degree>;
  using Rule = detail::GaussRule<degree>;
  constexpr std::size_t side = Tables::side;
  Tables tables;
  for (std::size_t q = 0; q < Tables::points; ++q) {
    const std::array<std::size_t, 3> at{q % side, q / side % side, q / (side * side)};
    const std::array<double, 3> x{Rule::point[at[0]], Rule::point[at[1]], Rule::point[at[2]]};
    tables.weight[q] = Rule::weight[at[0]] * Rule::weight[at[1]] * Rule::weight[at[2]];
    const auto lx = detail::lagrange<degree>(x[0]);
    const auto ly = detail::lagrange<degree>(x[1]);
    const auto lz = detail::lagrange<degree>(x[2]);
    for (std::size_t a = 0; a < Tables::nodes; ++a) {
      const auto& fx = lx[a % side];
      const auto& fy = ly[a / side % side];
      const auto& fz = lz[a / (side * side)];
      tables.value[q][a] = fx[0] * fy[0] * fz[0];
      tables.gradient[q][a] = {fx[1] * fy[0] * fz[0], fx[0] * fy[1] * fz[0], fx[0] * fy[0] * fz[1]};
    }
    tables.mode[q][0] = 1.0;
    if constexpr (degree == 2) {
      for (std::size_t c = 0; c < 3; ++c) tables.mode[q][c + 1] = x[c];
    }
  }
  return tables;
}

}  // namespace menger::fem
