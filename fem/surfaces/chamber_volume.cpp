#include "fem/surfaces/chamber_volume.h"

namespace menger::fem {
namespace {

/// Coefficients of the cubic form of a face of n nodes.
template <std::size_t n>
using Triples = std::array<std::array<std::array<double, n>, n>, n>;

/// The factor of one direction in int N_a N_b,u N_c,v: the integral of value a, value or derivative b, value or derivative c.
template <std::size_t degree>
constexpr Triples<degree + 1> line_integrals(bool derive_second) {
  Triples<degree + 1> integrals{};
  for (const QuadraturePoint& point : gauss_rule<degree + 1>()) {
    const auto values = shape_values<degree>(point.position);
    const auto derivatives = shape_derivatives<degree>(point.position);
    const auto& second = derive_second ? derivatives : values;
    const auto& third = derive_second ? values : derivatives;
    for (std::size_t a = 0; a <= degree; ++a)
      for (std::size_t b = 0; b <= degree; ++b)
        for (std::size_t c = 0; c <= degree; ++c) integrals[a][b][c] += point.weight * values[a] * second[b] * third[c];
  }
  return integrals;
}

/// The coefficients S_abc of V = -1/3 sum S_abc x_a . (x_b x x_c). The triple product changes its sign when two factors change
/// places, so only the alternating part of int N_a N_b,u N_c,v counts: S changes its sign when two indices change places.
template <std::size_t n>
constexpr Triples<n> volume_coefficients() {
  constexpr std::size_t degree = face_degree<n>;
  constexpr std::size_t width = degree + 1;
  constexpr auto along_u = line_integrals<degree>(true);
  constexpr auto along_v = line_integrals<degree>(false);
  const auto integral = [&](std::size_t a, std::size_t b, std::size_t c) {
    return along_u[a % width][b % width][c % width] * along_v[a / width][b / width][c / width];
  };
  Triples<n> result{};
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      for (std::size_t c = b + 1; c < n; ++c) {
        const double s = (integral(a, b, c) + integral(b, c, a) + integral(c, a, b) - integral(a, c, b) - integral(b, a, c) -
                          integral(c, b, a)) /
                         6.0;
        result[a][b][c] = result[b][c][a] = result[c][a][b] = s;
        result[a][c][b] = result[b][a][c] = result[c][b][a] = -s;
      }
    }
  }
  return result;
}

template <std::size_t n>
constexpr Triples<n> coefficients = volume_coefficients<n>();

template <std::size_t n>
FaceNodes<n> relative_to(const Point& origin, const FaceNodes<n>& nodes) {
  FaceNodes<n> result;
  for (std::size_t a = 0; a < n; ++a) result[a] = difference(nodes[a], origin);
  return result;
}

/// Returns sum_c S_abc x_c.
template <std::size_t n>
Point contracted(std::size_t a, std::size_t b, const FaceNodes<n>& x) {
  Point result{};
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t i = 0; i < 3; ++i) result[i] += coefficients<n>[a][b][c] * x[c][i];
  return result;
}

/// Returns dV/dx_a = -sum_bc S_abc x_b x x_c for positions relative to the origin. Pairs (b, c) and (c, b) give the same.
template <std::size_t n>
Point node_gradient(std::size_t a, const FaceNodes<n>& x) {
  Point result{};
  for (std::size_t b = 0; b < n; ++b) {
    Point later{};
    for (std::size_t c = b + 1; c < n; ++c)
      for (std::size_t i = 0; i < 3; ++i) later[i] += coefficients<n>[a][b][c] * x[c][i];
    result = sum(result, scaled(-2.0, cross(x[b], later)));
  }
  return result;
}

}  // namespace

template <std::size_t n>
double chamber_volume(const FaceNodes<n>& nodes, const Point& origin) {
  const FaceNodes<n> x = relative_to(origin, nodes);
  double volume = 0.0;
  for (std::size_t a = 0; a < n; ++a) volume += dot(x[a], node_gradient(a, x));
  return volume / 3.0;  // Euler's theorem for a form of degree 3
}

template <std::size_t n>
std::array<double, 3 * n> chamber_volume_gradient(const FaceNodes<n>& nodes, const Point& origin) {
  const FaceNodes<n> x = relative_to(origin, nodes);
  std::array<double, 3 * n> gradient{};
  for (std::size_t a = 0; a < n; ++a) {
    const Point g = node_gradient(a, x);
    for (std::size_t i = 0; i < 3; ++i) gradient[3 * a + i] = g[i];
  }
  return gradient;
}

template <std::size_t n>
std::array<double, 9 * n * n> chamber_volume_hessian(const FaceNodes<n>& nodes, const Point& origin) {
  const FaceNodes<n> x = relative_to(origin, nodes);
  std::array<double, 9 * n * n> hessian{};
  const auto set = [&](std::size_t a, std::size_t i, std::size_t b, std::size_t j, double value) {
    hessian[(3 * a + i) * 3 * n + 3 * b + j] = value;
    hessian[(3 * b + j) * 3 * n + 3 * a + i] = value;
  };
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {  // a node's own block vanishes: V is linear in each node
      const Point w = contracted(a, b, x);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        set(a, i, b, j, -2.0 * w[k]);
        set(a, j, b, i, 2.0 * w[k]);
      }
    }
  }
  return hessian;
}

template double chamber_volume(const FaceNodes<4>&, const Point&);
template double chamber_volume(const FaceNodes<9>&, const Point&);
template std::array<double, 12> chamber_volume_gradient(const FaceNodes<4>&, const Point&);
template std::array<double, 27> chamber_volume_gradient(const FaceNodes<9>&, const Point&);
template std::array<double, 144> chamber_volume_hessian(const FaceNodes<4>&, const Point&);
template std::array<double, 729> chamber_volume_hessian(const FaceNodes<9>&, const Point&);

}  // namespace menger::fem
