#include "fem/implicit/implicit_viscosity.h"

#include <algorithm>
#include <array>
#include <utility>

#include "fem/elements/element_shape_tables.h"
#include "fem/surfaces/point.h"

namespace menger::fem {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix cofactor_of(const Matrix& A) {
  Matrix C;
  for (std::size_t i = 0; i < 3; ++i) C[i] = cross(A[(i + 1) % 3], A[(i + 2) % 3]);
  return C;
}

/// A quadrature point of an element in its current shape.
template <int degree>
struct CurrentPoint {
  static constexpr auto shape = element_shape_tables<degree>();
  double volume;                             ///< in the reference configuration
  std::array<Point, shape.nodes> gradients;  ///< dN_a/dx, 1/m
};

/// Computes the gradients by the reference coordinates, then by the current ones: dN/dx = F^-T dN/dX with F = I + sum u_a
/// dN_a/dX.
template <int degree>
CurrentPoint<degree> point_of(const Space& space, const Index* nodes, std::span<const double> u, std::size_t q) {
  constexpr const auto& shape = CurrentPoint<degree>::shape;
  Matrix reference{};  // dX_i / dxi_j
  Matrix current{};    // dx_i / dxi_j
  for (std::size_t a = 0; a < shape.nodes; ++a) {
    const auto node = static_cast<std::size_t>(nodes[a]);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const double slope = shape.gradient[q][a][j];
        reference[i][j] += space.positions[node][i] * slope;
        current[i][j] += (space.positions[node][i] + u[3 * node + i]) * slope;
      }
    }
  }
  const Matrix C = cofactor_of(current);
  const double inverse = 1.0 / dot(current[0], C[0]);
  CurrentPoint<degree> point;
  point.volume = shape.weight[q] * dot(reference[0], cofactor_of(reference)[0]);
  for (std::size_t a = 0; a < shape.nodes; ++a)
    for (std::size_t i = 0; i < 3; ++i) point.gradients[a][i] = inverse * dot(C[i], shape.gradient[q][a]);
  return point;
}

template <int degree>
double add_forces_of(const Space& space, const std::vector<double>& viscosities, std::span<const double> u,
                     std::span<const double> v, std::span<double> forces) {
  constexpr const auto& shape = CurrentPoint<degree>::shape;
  double dissipated = 0.0;
  for (std::size_t e = 0; e < space.local_element_count(); ++e) {
    const double viscosity = viscosities[space.element_regions[e]];
    if (viscosity == 0.0) continue;
    const Index* nodes = space.element_nodes.data() + e * shape.nodes;
    for (std::size_t q = 0; q < shape.points; ++q) {
      const CurrentPoint<degree> point = point_of<degree>(space, nodes, u, q);
      Matrix rate{};  // dv_i / dx_j
      for (std::size_t a = 0; a < shape.nodes; ++a)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) rate[i][j] += v[3 * static_cast<std::size_t>(nodes[a]) + i] * point.gradients[a][j];
      const double mean = (rate[0][0] + rate[1][1] + rate[2][2]) / 3.0;
      Matrix stress;  // 2 eta dev d times the volume
      double square = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          const double d = 0.5 * (rate[i][j] + rate[j][i]) - (i == j ? mean : 0.0);
          square += d * d;
          stress[i][j] = 2.0 * viscosity * point.volume * d;
        }
      }
      dissipated += 2.0 * viscosity * point.volume * square;
      for (std::size_t a = 0; a < shape.nodes; ++a)
        for (std::size_t i = 0; i < 3; ++i)
          forces[3 * static_cast<std::size_t>(nodes[a]) + i] += dot(stress[i], point.gradients[a]);
    }
  }
  return dissipated;
}

template <int degree>
void add_matrix_of(const Assembly& assembly, const std::vector<double>& viscosities, std::span<const double> u, double factor,
                   Mat matrix) {
  constexpr const auto& shape = CurrentPoint<degree>::shape;
  constexpr std::size_t columns = 3 * shape.nodes;
  const Space& space = assembly.space();
  std::vector<double> block;
  for (std::size_t e = 0; e < space.local_element_count(); ++e) {
    const double viscosity = factor * viscosities[space.element_regions[e]];
    if (viscosity == 0.0) continue;
    const auto nodes = std::span(space.element_nodes).subspan(e * shape.nodes, shape.nodes);
    block.assign(columns * columns, 0.0);
    for (std::size_t q = 0; q < shape.points; ++q) {
      const CurrentPoint<degree> point = point_of<degree>(space, nodes.data(), u, q);
      const double weight = viscosity * point.volume;
      for (std::size_t a = 0; a < shape.nodes; ++a) {
        const Point& g = point.gradients[a];
        for (std::size_t b = 0; b <= a; ++b) {
          const Point& h = point.gradients[b];
          const double product = weight * dot(g, h);
          for (std::size_t i = 0; i < 3; ++i) {
            double* row = &block[(3 * a + i) * columns + 3 * b];
            for (std::size_t k = 0; k < 3; ++k) row[k] += weight * (g[k] * h[i] - 2.0 / 3.0 * g[i] * h[k]);
            row[i] += product;
          }
        }
      }
    }
    for (std::size_t row = 0; row < columns; ++row)
      for (std::size_t column = row + 1; column < columns; ++column)
        block[row * columns + column] = block[column * columns + row];
    assembly.add_to_matrix(matrix, nodes, block);
  }
}

}  // namespace

ImplicitViscosity::ImplicitViscosity(const Space& space, std::vector<double> viscosities_Pa_s)
    : space_(space),
      viscosities_(std::move(viscosities_Pa_s)),
      is_zero_(std::all_of(viscosities_.begin(), viscosities_.end(), [](double eta) { return eta == 0.0; })) {}

double ImplicitViscosity::add_forces(std::span<const double> displacements_m, std::span<const double> velocities_m_per_s,
                                     std::span<double> forces_N) const {
  if (is_zero_) return 0.0;
  return space_.degree == 1 ? add_forces_of<1>(space_, viscosities_, displacements_m, velocities_m_per_s, forces_N)
                            : add_forces_of<2>(space_, viscosities_, displacements_m, velocities_m_per_s, forces_N);
}

void ImplicitViscosity::add_matrix(const Assembly& assembly, std::span<const double> displacements_m, double factor,
                                   Mat matrix) const {
  if (is_zero_) return;
  if (space_.degree == 1) {
    add_matrix_of<1>(assembly, viscosities_, displacements_m, factor, matrix);
  } else {
    add_matrix_of<2>(assembly, viscosities_, displacements_m, factor, matrix);
  }
}

}  // namespace menger::fem
