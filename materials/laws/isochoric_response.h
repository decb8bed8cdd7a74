#pragma once

#include "materials/laws/invariant_energy.h"
#include "materials/laws/kinematics.h"
#include "materials/laws/law_status.h"

namespace menger::materials {

/// The first Piola-Kirchhoff stress P = d psi / dF and its derivative dP/dF, Pa.
template <class T>
struct StressAndTangent {
  Tensor<T> stress;
  Tangent<T> tangent;
};

/// Returns the isochoric energy psi(F) = W(J^(-1/3) F) of a law, J/m^3.
template <InvariantLaw Law, class T>
T strain_energy_density(const Law& law, const Kinematics<T>& k) {
  return law.energy(k.first_excess, k.second_excess).energy;
}

/// Returns the derivative of the isochoric first invariant, d I1 / dF = 2 J^(-2/3) (F - tr(C)/3 F^-T).
template <class T>
Tensor<T> first_invariant_gradient(const Kinematics<T>& k) {
  const T factor = T(2.0) * k.isochoric_factor;
  const T inverse_factor = -(factor * k.mean_square_stretch);
  return combination(factor, k.deformation_gradient, inverse_factor, k.inverse_transpose);
}

/// Returns the derivative of the second invariant of F itself, 2 (I1 F - F C).
template <class T>
Tensor<T> plain_second_invariant_gradient(const Kinematics<T>& k) {
  const T factor = T(6.0) * k.mean_square_stretch;
  return combination(factor, k.deformation_gradient, T(-2.0), product(k.deformation_gradient, k.right_cauchy_green));
}

/// Returns the second invariant of F itself.
template <class T>
T plain_second_invariant(const Kinematics<T>& k) {
  return T(3.0) * k.mean_square_stretch * k.mean_square_stretch - k.square_deviator;
}

/// Returns the derivative of the isochoric second invariant J^(-4/3) I2 by F: J^(-4/3) (2 (I1 F - F C) - 4/3 I2 F^-T). Here I1
/// and I2 are the plain invariants of C = F^T F.
template <class T>
Tensor<T> second_invariant_gradient(const Kinematics<T>& k) {
  const T factor = k.isochoric_factor * k.isochoric_factor;
  const T inverse_factor = T(-4.0 / 3.0) * factor * plain_second_invariant(k);
  return combination(factor, plain_second_invariant_gradient(k), inverse_factor, k.inverse_transpose);
}

/// Returns the isochoric stress P = d psi / dF.
template <InvariantLaw Law, class T>
Tensor<T> first_piola_stress(const Law& law, const Kinematics<T>& k) {
  const InvariantEnergy<T> w = law.energy(k.first_excess, k.second_excess);
  Tensor<T> gradient = first_invariant_gradient(k);
  if constexpr (Law::uses_second_invariant) return combination(w.d1, gradient, w.d2, second_invariant_gradient(k));
  for (T& component : gradient.components) component = component * w.d1;
  return gradient;
}

namespace detail {

/// Sets the upper triangle of a tangent to w.d1 d2I1/dF2 + w.d11 dI1 (x) dI1, with G = F^-T:
/// d2I1/dF2 = J^(-2/3) (2 d_ik d_JL - 4/3 (F (x) G + G (x) F) + 4/9 I1 G (x) G + 2/3 I1 G_iL G_kJ).
template <class T>
void set_first_part(Tangent<T>& tangent, const InvariantEnergy<T>& w, const Kinematics<T>& k, const Tensor<T>& gradient) {
  const Tensor<T>& F = k.deformation_gradient;
  const Tensor<T>& G = k.inverse_transpose;
  const T factor = w.d1 * k.isochoric_factor;
  const T mixed = T(-4.0 / 3.0) * factor;
  const T inverse_pair = T(4.0 / 3.0) * factor * k.mean_square_stretch;
  const T crossed = T(2.0) * factor * k.mean_square_stretch;
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a; b < 9; ++b) {
      T value = mixed * (F.components[a] * G.components[b] + G.components[a] * F.components[b]) +
                inverse_pair * G.components[a] * G.components[b] + crossed * G(a / 3, b % 3) * G(b / 3, a % 3) +
                w.d11 * gradient.components[a] * gradient.components[b];
      if (a == b) value = value + T(2.0) * factor;
      tangent(a, b) = value;
    }
  }
}

/// Adds the terms of the second invariant to the upper triangle, with H = dI2/dF of F itself, B = F F^T, G = F^-T:
/// d2I2/dF2 = J^(-4/3) (4 F (x) F + 2 I1 d_ik d_JL - 2 (d_ik C_JL + F_iL F_kJ + B_ik d_JL)
///                      - 4/3 (H (x) G + G (x) H) + 16/9 I2 G (x) G + 4/3 I2 G_iL G_kJ).
template <class T>
void add_second_part(Tangent<T>& tangent, const InvariantEnergy<T>& w, const Kinematics<T>& k, const Tensor<T>& gradient) {
  const Tensor<T>& F = k.deformation_gradient;
  const Tensor<T>& G = k.inverse_transpose;
  const Tensor<T>& C = k.right_cauchy_green;
  const Tensor<T> B = product(F, transpose(F));
  const Tensor<T> H = plain_second_invariant_gradient(k);
  const Tensor<T> second = second_invariant_gradient(k);
  const T invariant = plain_second_invariant(k);
  const T factor = w.d2 * k.isochoric_factor * k.isochoric_factor;
  const T twice_first = T(6.0) * k.mean_square_stretch;
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = a; b < 9; ++b) {
      const T& fa = F.components[a];
      const T& fb = F.components[b];
      const T& ga = G.components[a];
      const T& gb = G.components[b];
      T value = T(4.0) * fa * fb - T(2.0) * F(a / 3, b % 3) * F(b / 3, a % 3) -
                T(4.0 / 3.0) * (H.components[a] * gb + ga * H.components[b]) + T(16.0 / 9.0) * invariant * ga * gb +
                T(4.0 / 3.0) * invariant * G(a / 3, b % 3) * G(b / 3, a % 3);
      if (a == b) value = value + twice_first;
      if (a / 3 == b / 3) value = value - T(2.0) * C(a % 3, b % 3);
      if (a % 3 == b % 3) value = value - T(2.0) * B(a / 3, b / 3);
      tangent(a, b) = tangent(a, b) + factor * value +
                      w.d12 * (gradient.components[a] * second.components[b] + second.components[a] * gradient.components[b]) +
                      w.d22 * second.components[a] * second.components[b];
    }
  }
}

/// Copies the upper triangle of a tangent to the lower one.
template <class T>
void mirror(Tangent<T>& tangent) {
  for (std::size_t a = 0; a < 9; ++a)
    for (std::size_t b = a + 1; b < 9; ++b) tangent(b, a) = tangent(a, b);
}

}  // namespace detail

/// Returns the isochoric stress and its tangent dP/dF, which is exactly symmetric.
template <InvariantLaw Law, class T>
StressAndTangent<T> stress_and_tangent(const Law& law, const Kinematics<T>& k) {
  const InvariantEnergy<T> w = law.energy(k.first_excess, k.second_excess);
  const Tensor<T> gradient = first_invariant_gradient(k);
  StressAndTangent<T> result;
  detail::set_first_part(result.tangent, w, k, gradient);
  if constexpr (Law::uses_second_invariant) {
    detail::add_second_part(result.tangent, w, k, gradient);
    result.stress = combination(w.d1, gradient, w.d2, second_invariant_gradient(k));
  } else {
    for (std::size_t n = 0; n < 9; ++n) result.stress.components[n] = w.d1 * gradient.components[n];
  }
  detail::mirror(result.tangent);
  return result;
}

/// Returns whether the law is valid at F. Check it before you use stress or energy.
template <InvariantLaw Law>
LawStatus status_of(const Law& law, const Kinematics<double>& k) {
  if (!(k.volume_ratio > 0.0)) return LawStatus::inverted;
  return law.is_within_limit(k.first_excess) ? LawStatus::valid : LawStatus::locking_stretch_exceeded;
}

}  // namespace menger::materials
