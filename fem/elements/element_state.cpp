#include "fem/elements/element_state.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>

#include "fem/elements/element_shape_tables.h"
#include "materials/laws/nearly_incompressible.h"
#include "materials/laws/principal_axes.h"

namespace menger::fem {
namespace {

using materials::Tensor;

template <int degree>
MeanDeformation mean_of_degree(std::span<const double> positions_m, std::span<const double> displacements_m) {
  static constexpr auto shape = element_shape_tables<degree>();
  assert(positions_m.size() == 3 * shape.nodes && displacements_m.size() == 3 * shape.nodes);
  MeanDeformation mean;
  mean.volume_ratio = 0.0;
  double volume = 0.0;
  for (std::size_t q = 0; q < shape.points; ++q) {
    Tensor<double> X{};  // by the reference coordinates
    Tensor<double> u{};
    for (std::size_t a = 0; a < shape.nodes; ++a) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          X(i, j) += positions_m[3 * a + i] * shape.gradient[q][a][j];
          u(i, j) += displacements_m[3 * a + i] * shape.gradient[q][a][j];
        }
      }
    }
    const Tensor<double> cofactors = materials::cofactor(X);
    const double determinant = materials::determinant(X, cofactors);
    const double weight = shape.weight[q] * determinant;
    const Tensor<double> slope = materials::product(u, materials::transpose(cofactors));
    Tensor<double> F = materials::identity<double>();
    for (std::size_t n = 0; n < 9; ++n) F.components[n] += slope.components[n] / determinant;
    for (std::size_t n = 0; n < 9; ++n) mean.gradient[n] += weight * F.components[n];
    mean.volume_ratio += weight * materials::determinant(F);
    volume += weight;
  }
  for (double& component : mean.gradient) component /= volume;
  mean.volume_ratio /= volume;
  return mean;
}

}  // namespace

MeanDeformation mean_deformation(int degree, std::span<const double> positions_m, std::span<const double> displacements_m) {
  assert(degree == 1 || degree == 2);
  return degree == 1 ? mean_of_degree<1>(positions_m, displacements_m) : mean_of_degree<2>(positions_m, displacements_m);
}

ElementState element_state(const materials::HyperelasticLaw& law, const MeanDeformation& deformation) {
  ElementState state{deformation.volume_ratio, principal_stretches(deformation.gradient)[0],
                     std::numeric_limits<double>::quiet_NaN()};
  const Tensor<double> F{deformation.gradient};
  if (!(materials::determinant(F) > 0.0)) return state;
  const materials::Kinematics<double> k = materials::kinematics_of(F);
  std::visit(
      [&](const auto& of_shape) {
        if (materials::status_of(of_shape, k) != materials::LawStatus::valid) return;
        const Tensor<double> tau = materials::product(materials::first_piola_stress(of_shape, k), materials::transpose(F));
        const double J = k.volume_ratio;
        state.von_mises_stress_Pa =
            von_mises_stress({tau(0, 0) / J, tau(1, 1) / J, tau(2, 2) / J, tau(0, 1) / J, tau(1, 2) / J, tau(0, 2) / J});
      },
      law);
  return state;
}

std::array<double, 3> principal_stretches(const std::array<double, 9>& deformation_gradient) {
  const Tensor<double> F{deformation_gradient};
  std::array<double, 3> stretches = materials::principal_axes(materials::product(materials::transpose(F), F)).values;
  for (double& stretch : stretches) stretch = std::sqrt(std::max(0.0, stretch));
  std::sort(stretches.begin(), stretches.end(), std::greater<>());
  return stretches;
}

double von_mises_stress(const std::array<double, 6>& s) {
  const auto square = [](double x) { return x * x; };
  return std::sqrt(0.5 * (square(s[0] - s[1]) + square(s[1] - s[2]) + square(s[2] - s[0])) +
                   3.0 * (square(s[3]) + square(s[4]) + square(s[5])));
}

double hydrostatic_pressure(const std::array<double, 6>& cauchy_stress) {
  return -(cauchy_stress[0] + cauchy_stress[1] + cauchy_stress[2]) / 3.0;
}

}  // namespace menger::fem
