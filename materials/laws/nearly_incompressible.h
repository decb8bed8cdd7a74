#pragma once

#include "materials/laws/isochoric_response.h"
#include "materials/laws/ogden_response.h"
#include "materials/laws/volumetric_energy.h"

namespace menger::materials {

/// A nearly incompressible material, psi(F) = psi_iso(J^(-1/3) F) + U(J): a law for the change of shape and one for the change of
/// volume.
template <class Law, class Volume>
struct NearlyIncompressible {
  Law law;
  Volume volume;
};

/// Returns the strain energy density, J/m^3 of reference volume.
template <class Law, class Volume, class T>
T strain_energy_density(const NearlyIncompressible<Law, Volume>& material, const Tensor<T>& F) {
  const Kinematics<T> k = kinematics_of(F);
  const T isochoric = strain_energy_density(material.law, k);
  const T volumetric = material.volume.energy(k.volume_ratio);
  return isochoric + volumetric;
}

/// Returns the first Piola-Kirchhoff stress, Pa. Its volumetric part is U'(J) J F^-T.
template <class Law, class Volume, class T>
Tensor<T> first_piola_stress(const NearlyIncompressible<Law, Volume>& material, const Tensor<T>& F) {
  const Kinematics<T> k = kinematics_of(F);
  const T tau = material.volume.derivative(k.volume_ratio) * k.volume_ratio;
  return combination(T(1.0), first_piola_stress(material.law, k), tau, k.inverse_transpose);
}

/// Returns the stress and its tangent dP/dF. The volumetric tangent is (U'' J^2 + U' J) G (x) G - U' J G_iL G_kJ with G = F^-T.
template <class Law, class Volume, class T>
StressAndTangent<T> stress_and_tangent(const NearlyIncompressible<Law, Volume>& material, const Tensor<T>& F) {
  const Kinematics<T> k = kinematics_of(F);
  const Tensor<T>& G = k.inverse_transpose;
  const T tau = material.volume.derivative(k.volume_ratio) * k.volume_ratio;
  const T dyad = tau + material.volume.second_derivative(k.volume_ratio) * k.volume_ratio * k.volume_ratio;
  StressAndTangent<T> result = stress_and_tangent(material.law, k);
  for (std::size_t a = 0; a < 9; ++a) {
    result.stress.components[a] = result.stress.components[a] + tau * G.components[a];
    for (std::size_t b = 0; b < 9; ++b) {
      result.tangent(a, b) =
          result.tangent(a, b) + dyad * G.components[a] * G.components[b] - tau * G(a / 3, b % 3) * G(b / 3, a % 3);
    }
  }
  return result;
}

/// Returns whether the material is valid at F. Check it before you use stress or energy.
template <class Law, class Volume>
LawStatus status_of(const NearlyIncompressible<Law, Volume>& material, const Tensor<double>& F) {
  return status_of(material.law, kinematics_of(F));
}

}  // namespace menger::materials
