#pragma once

#include <array>
#include <cmath>

#include "materials/laws/accurate_functions.h"
#include "materials/laws/tensor.h"

namespace menger::materials {

/// A symmetric 3x3 tensor in its principal axes, A = sum_a values[a] N_a (x) N_a. The order is arbitrary.
template <class T>
struct PrincipalAxes {
  std::array<T, 3> values;
  Tensor<T> axes;  ///< N_a is column a; orthonormal, even if values are equal
};

/// Computes principal axes by cyclic Jacobi rotations.
///
/// The number of sweeps is fixed and there are no branches, so that the function works with SIMD packs. Errors are of the order
/// of rounding relative to the largest value, for any spacing of the values. With a type of automatic differentiation the
/// derivatives are right if the values are distinct.
template <class T>
MENGER_HOST_DEVICE PrincipalAxes<T> principal_axes(const Tensor<T>& symmetric) {
  using std::abs;
  using std::sqrt;
  constexpr int sweeps = 6;  // quadratic convergence is complete after four sweeps; derivatives need more
  constexpr std::array<std::array<std::size_t, 3>, 3> planes{{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}};
  Tensor<T> A = symmetric;
  Tensor<T> N = identity<T>();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (const auto& [p, q, r] : planes) {
      const T difference = A(q, q) - A(p, p);
      const T off = A(p, q);
      const T sign = select(difference < T(0.0), T(-1.0), T(1.0));
      const T root = sqrt(difference * difference + T(4.0) * off * off);
      const T tangent = T(2.0) * sign * off / (abs(difference) + root + T(1e-30));  // the smaller of the two angles
      const T cosine = T(1.0) / sqrt(T(1.0) + tangent * tangent);
      const T sine = tangent * cosine;
      const T shift = tangent * off;
      const T first = cosine * A(p, r) - sine * A(q, r);
      const T second = sine * A(p, r) + cosine * A(q, r);
      A(p, p) = A(p, p) - shift;
      A(q, q) = A(q, q) + shift;
      A(p, q) = T(0.0);
      A(q, p) = T(0.0);
      A(p, r) = first;
      A(r, p) = first;
      A(q, r) = second;
      A(r, q) = second;
      for (std::size_t i = 0; i < 3; ++i) {
        const T along_p = cosine * N(i, p) - sine * N(i, q);
        const T along_q = sine * N(i, p) + cosine * N(i, q);
        N(i, p) = along_p;
        N(i, q) = along_q;
      }
    }
  }
  return {{A(0, 0), A(1, 1), A(2, 2)}, N};
}

}  // namespace menger::materials
