#pragma once

#include <array>

#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/law_status.h"

namespace menger::materials {

/// The homogeneous deformations of an incompressible body with one face free of stress.
enum class LoadingMode {
  uniaxial,     ///< stretches l, l^-1/2, l^-1/2
  equibiaxial,  ///< stretches l, l, l^-2
  planar        ///< stretches l, 1, 1/l: pure shear, a wide strip
};

/// Returns the principal stretches of a mode; the last face is free of stress. @param stretch l > 0
std::array<double, 3> stretches_of(LoadingMode mode, double stretch);

/// First and second derivatives of W with respect to the logarithms of the principal stretches of an incompressible body, J/m^3.
///
/// Incompressibility leaves an arbitrary pressure undetermined. So only differences between directions have a meaning: sigma_a -
/// sigma_b = slopes[a] - slopes[b].
struct PrincipalDerivatives {
  LawStatus status = LawStatus::valid;  ///< the derivatives have a meaning only if valid
  std::array<double, 3> slopes{};
  std::array<std::array<double, 3>, 3> curvatures{};
};

/// Returns the derivatives of W at three principal stretches. @param stretches three positive numbers with product 1
[[nodiscard]] PrincipalDerivatives principal_derivatives(const HyperelasticLaw& law, const std::array<double, 3>& stretches);

/// A stress, or the reason why there is none.
struct NominalStress {
  LawStatus status = LawStatus::valid;
  double stress_Pa = 0.0;  ///< force divided by reference area along the first stretch, tension positive; 0 unless valid
};

/// Returns the nominal stress P = (sigma_1 - sigma_3) / l of a homogeneous deformation whose last face is free of stress.
/// @param stretch l; if it is not positive the status is LawStatus::inverted
[[nodiscard]] NominalStress nominal_stress(const HyperelasticLaw& law, LoadingMode mode, double stretch);

}  // namespace menger::materials
