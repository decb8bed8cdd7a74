#pragma once

#include <cmath>

#include "materials/laws/tensor.h"

namespace menger::materials {

/// The quantities of a deformation gradient F (3x3, det F > 0) that the laws need, with C = F^T F and J = det F.
template <class T>
struct Kinematics {
  Tensor<T> deformation_gradient;  ///< F
  Tensor<T> inverse_transpose;     ///< F^-T
  Tensor<T> right_cauchy_green;    ///< C
  T volume_ratio;                  ///< J
  T mean_square_stretch;           ///< tr(C) / 3
  T square_deviator;               ///< q = dev(C):dev(C) / 2, so that I2 = 3 (tr(C)/3)^2 - q
  T isochoric_factor;              ///< J^(-2/3)
  T first_excess;                  ///< J^(-2/3) I1 - 3 >= 0
  T second_excess;                 ///< J^(-4/3) I2 - 3 >= 0
};

/// Computes the kinematics of F. Both excesses are computed from the deviator of C, because I1 - 3 would lose digits. Their
/// relative error is about the rounding error divided by the strain, not by its square.
template <class T>
Kinematics<T> kinematics_of(const Tensor<T>& F) {
  using std::exp;
  using std::log;
  Kinematics<T> k;
  k.deformation_gradient = F;
  k.right_cauchy_green = product(transpose(F), F);
  const Tensor<T>& C = k.right_cauchy_green;
  const Tensor<T> cofactors = cofactor(F);
  k.volume_ratio = determinant(F, cofactors);
  const T inverse_ratio = T(1.0) / k.volume_ratio;
  for (std::size_t n = 0; n < 9; ++n) k.inverse_transpose.components[n] = cofactors.components[n] * inverse_ratio;

  const T mean = (C(0, 0) + C(1, 1) + C(2, 2)) * T(1.0 / 3.0);
  Tensor<T> deviator = C;
  for (std::size_t i = 0; i < 3; ++i) {
    const T& other = C((i + 1) % 3, (i + 1) % 3);
    const T& third = C((i + 2) % 3, (i + 2) % 3);
    deviator(i, i) = ((C(i, i) - other) + (C(i, i) - third)) * T(1.0 / 3.0);
  }
  T square(0.0);
  for (const T& component : deviator.components) square = square + component * component;
  k.mean_square_stretch = mean;
  k.square_deviator = T(0.5) * square;

  // det C = m^3 - m q + det(dev C) gives J^2 / m^3 = 1 + x with m = tr(C)/3; then J^(-2/3) m = (1 + x)^(-1/3) = r.
  const T inverse_mean = T(1.0) / mean;
  const T relative_square = k.square_deviator * inverse_mean * inverse_mean;
  const T x = determinant(deviator) * inverse_mean * inverse_mean * inverse_mean - relative_square;
  const T r = exp(log(T(1.0) + x) * T(-1.0 / 3.0));
  const T r_excess = -x / ((T(1.0) + x) * (r * r + r + T(1.0)));  // r - 1 = (r^3 - 1) / (r^2 + r + 1)
  k.isochoric_factor = r * inverse_mean;
  k.first_excess = T(3.0) * r_excess;
  k.second_excess = T(3.0) * r_excess * (r + T(1.0)) - relative_square * r * r;
  return k;
}

}  // namespace menger::materials
