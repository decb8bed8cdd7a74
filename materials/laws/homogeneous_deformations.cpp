#include "materials/laws/homogeneous_deformations.h"

#include <cmath>

namespace menger::materials {

namespace {

/// Computes the derivatives for W(I1, I2) with I1 = sum l^2 and I2 = sum l^-2: dW/d ln l_a = 2 W1 l_a^2 - 2 W2 l_a^-2.
template <InvariantLaw Law>
PrincipalDerivatives derivatives(const Law& law, const std::array<double, 3>& stretches) {
  std::array<double, 3> square{};
  std::array<double, 3> inverse{};
  double x1 = -3.0;
  double x2 = -3.0;
  for (std::size_t a = 0; a < 3; ++a) {
    square[a] = stretches[a] * stretches[a];
    inverse[a] = 1.0 / square[a];
    x1 += square[a];
    x2 += inverse[a];
  }
  PrincipalDerivatives result;
  if (!law.is_within_limit(x1)) result.status = LawStatus::locking_stretch_exceeded;
  const InvariantEnergy<double> w = law.energy(x1, x2);
  for (std::size_t a = 0; a < 3; ++a) {
    result.slopes[a] = 2.0 * (w.d1 * square[a] - w.d2 * inverse[a]);
    for (std::size_t b = 0; b < 3; ++b) {
      result.curvatures[a][b] = 4.0 * (w.d11 * square[a] * square[b] + w.d22 * inverse[a] * inverse[b] -
                                       w.d12 * (square[a] * inverse[b] + inverse[a] * square[b]));
    }
    result.curvatures[a][a] += 4.0 * (w.d1 * square[a] + w.d2 * inverse[a]);
  }
  return result;
}

template <std::size_t n>
PrincipalDerivatives derivatives(const Ogden<n>& law, const std::array<double, 3>& stretches) {
  PrincipalDerivatives result;
  for (const OgdenTerm& term : law.terms) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double stress = term.modulus_Pa * std::pow(stretches[a], term.exponent);
      result.slopes[a] += stress;
      result.curvatures[a][a] += term.exponent * stress;
    }
  }
  return result;
}

}  // namespace

std::array<double, 3> stretches_of(LoadingMode mode, double stretch) {
  switch (mode) {
    case LoadingMode::uniaxial:
      return {stretch, 1.0 / std::sqrt(stretch), 1.0 / std::sqrt(stretch)};
    case LoadingMode::equibiaxial:
      return {stretch, stretch, 1.0 / (stretch * stretch)};
    case LoadingMode::planar:
      return {stretch, 1.0, 1.0 / stretch};
  }
  return {1.0, 1.0, 1.0};
}

PrincipalDerivatives principal_derivatives(const HyperelasticLaw& law, const std::array<double, 3>& stretches) {
  return std::visit([&](const auto& any) { return derivatives(any, stretches); }, law);
}

NominalStress nominal_stress(const HyperelasticLaw& law, LoadingMode mode, double stretch) {
  if (!(stretch > 0.0)) return {.status = LawStatus::inverted};
  const PrincipalDerivatives w = principal_derivatives(law, stretches_of(mode, stretch));
  if (w.status != LawStatus::valid) return {.status = w.status};
  return {.stress_Pa = (w.slopes[0] - w.slopes[2]) / stretch};
}

}  // namespace menger::materials
