#include "materials/laws/stability.h"

#include <cassert>
#include <cmath>

namespace menger::materials {

bool is_drucker_stable(const HyperelasticLaw& law, const std::array<double, 3>& stretches) {
  const PrincipalDerivatives w = principal_derivatives(law, stretches);
  if (w.status != LawStatus::valid) return false;
  const auto& h = w.curvatures;
  const auto entry = [&](std::size_t i, std::size_t j) { return h[i][j] - h[i][2] - h[2][j] + h[2][2]; };
  const double trace = entry(0, 0) + entry(1, 1);
  const double determinant = entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0);
  return trace > 0.0 && determinant > 0.0;
}

std::optional<double> first_unstable_stretch(const HyperelasticLaw& law, LoadingMode mode, double end) {
  assert(end > 0.0);
  constexpr double step = 0.005;
  const int steps = static_cast<int>(std::ceil(std::abs(end - 1.0) / step));
  for (int i = 0; i <= steps; ++i) {
    const double stretch = i == steps ? end : 1.0 + std::copysign(step * i, end - 1.0);
    if (!is_drucker_stable(law, stretches_of(mode, stretch))) return stretch;
  }
  return std::nullopt;
}

std::optional<double> equibiaxial_ratio(const HyperelasticLaw& law, double stretch) {
  const NominalStress equibiaxial = nominal_stress(law, LoadingMode::equibiaxial, stretch);
  const NominalStress uniaxial = nominal_stress(law, LoadingMode::uniaxial, stretch);
  if (equibiaxial.status != LawStatus::valid || uniaxial.status != LawStatus::valid || uniaxial.stress_Pa == 0.0) return {};
  return equibiaxial.stress_Pa / uniaxial.stress_Pa;
}

}  // namespace menger::materials
