#pragma once

#include <cmath>

#include "materials/laws/accurate_functions.h"
#include "materials/laws/isochoric_response.h"
#include "materials/laws/ogden.h"
#include "materials/laws/principal_axes.h"

namespace menger::materials {

/// A deformation in its principal axes: F = sum_a lambda_a n_a (x) N_a.
template <class T>
struct PrincipalStretches {
  std::array<T, 3> stretches;      ///< lambda_a
  std::array<T, 3> log_isochoric;  ///< e_a = ln(J^(-1/3) lambda_a); their sum is zero
  Tensor<T> reference_axes;        ///< N_a is column a
  Tensor<T> current_axes;          ///< n_a is column a
};

template <class T>
PrincipalStretches<T> principal_stretches(const Kinematics<T>& k) {
  using std::log;
  using std::sqrt;
  const PrincipalAxes<T> C = principal_axes(k.right_cauchy_green);
  PrincipalStretches<T> result;
  result.reference_axes = C.axes;
  result.current_axes = product(k.deformation_gradient, C.axes);
  for (std::size_t a = 0; a < 3; ++a) {
    result.stretches[a] = sqrt(C.values[a]);
    result.log_isochoric[a] = T(0.5) * log(C.values[a] * k.isochoric_factor);
    const T inverse = T(1.0) / result.stretches[a];
    for (std::size_t i = 0; i < 3; ++i) result.current_axes(i, a) = result.current_axes(i, a) * inverse;
  }
  return result;
}

/// Returns the isochoric energy psi(F), J/m^3. The e_a add up to zero, so sum exp(alpha e_a) - 3 equals the sum of exp(alpha e_a)
/// - 1 - alpha e_a, which loses no digits at small strain.
template <std::size_t n, class T>
T strain_energy_density(const Ogden<n>& law, const Kinematics<T>& k) {
  const PrincipalStretches<T> s = principal_stretches(k);
  T sum(0.0);
  for (const OgdenTerm& term : law.terms) {
    for (std::size_t a = 0; a < 3; ++a) {
      const T exponent = T(term.exponent) * s.log_isochoric[a];
      sum = sum + T(term.modulus_Pa / term.exponent) * exp_remainder<T>(exponent);
    }
  }
  return sum;
}

namespace detail {

/// The principal Kirchhoff stresses tau_a = d psi / d ln(lambda_a), and the derivatives that the tangent needs.
template <class T>
struct PrincipalStresses {
  std::array<T, 3> kirchhoff;
  Tensor<T> slopes;  ///< d tau_a / d ln(lambda_b)
  Tensor<T> shears;  ///< (tau_a - tau_b) / (lambda_a^2 - lambda_b^2), a != b, and its limit where the stretches are equal
};

/// Returns the difference quotient (x_a^s - x_b^s) / (x_a - x_b) of two squares of isochoric stretches x = exp(2 e), for a power
/// s. Where both are equal, it is the derivative s x^(s-1).
///
/// It is computed as s exp((s-1)(e_a + e_b)) sinhc(s h) / sinhc(h) with h = e_a - e_b and sinhc(x) = sinh(x) / x. This is smooth
/// at equal stretches, so no tolerance has to say when stretches count as equal.
/// @param e_a, e_b logarithms of the isochoric stretches
template <class T>
MENGER_HOST_DEVICE T power_difference_quotient(const T& e_a, const T& e_b, double s) {
  using std::exp;
  const T h = e_a - e_b;
  const T scaled = T(s) * h;
  const T scale = exp(T(s - 1.0) * (e_a + e_b));
  return T(s) * scale * (T(1.0) + sinhc_excess<T>(scaled)) / (T(1.0) + sinhc_excess<T>(h));
}

/// Returns tau_a = sum_p mu_p (w_a - S/3) with w_a = exp(alpha e_a) and S = w_1 + w_2 + w_3.
template <std::size_t n, class T>
std::array<T, 3> kirchhoff_stresses(const Ogden<n>& law, const PrincipalStretches<T>& s) {
  using std::exp;
  std::array<T, 3> tau{T(0.0), T(0.0), T(0.0)};
  for (const OgdenTerm& term : law.terms) {
    std::array<T, 3> w;
    for (std::size_t a = 0; a < 3; ++a) w[a] = exp(T(term.exponent) * s.log_isochoric[a]);
    const T mean = (w[0] + w[1] + w[2]) * T(1.0 / 3.0);
    for (std::size_t a = 0; a < 3; ++a) tau[a] = tau[a] + T(term.modulus_Pa) * (w[a] - mean);
  }
  return tau;
}

template <std::size_t n, class T>
PrincipalStresses<T> principal_stresses(const Ogden<n>& law, const PrincipalStretches<T>& s, const T& isochoric_factor) {
  using std::exp;
  PrincipalStresses<T> result{kirchhoff_stresses(law, s), {}, {}};
  for (std::size_t c = 0; c < 9; ++c) result.slopes.components[c] = result.shears.components[c] = T(0.0);
  for (const OgdenTerm& term : law.terms) {
    std::array<T, 3> w;
    for (std::size_t a = 0; a < 3; ++a) w[a] = exp(T(term.exponent) * s.log_isochoric[a]);
    const T ninth = (w[0] + w[1] + w[2]) * T(1.0 / 9.0);
    const T slope = T(term.modulus_Pa * term.exponent);
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        T derivative = ninth - (w[a] + w[b]) * T(1.0 / 3.0);
        if (a == b) derivative = derivative + w[a];
        result.slopes(a, b) = result.slopes(a, b) + slope * derivative;
        if (a == b) continue;
        const T quotient = power_difference_quotient<T>(s.log_isochoric[a], s.log_isochoric[b], 0.5 * term.exponent);
        result.shears(a, b) = result.shears(a, b) + T(term.modulus_Pa) * isochoric_factor * quotient;
      }
    }
  }
  return result;
}

/// Returns n_a (x) N_b.
template <class T>
Tensor<T> mixed_dyad(const PrincipalStretches<T>& s, std::size_t a, std::size_t b) {
  Tensor<T> dyad;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) dyad(i, j) = s.current_axes(i, a) * s.reference_axes(j, b);
  return dyad;
}

/// Returns P = sum_a tau_a/lambda_a n_a (x) N_a.
template <class T>
Tensor<T> stress_from_principal(const PrincipalStretches<T>& s, const std::array<T, 3>& tau) {
  Tensor<T> P;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      T sum(0.0);
      for (std::size_t a = 0; a < 3; ++a) sum = sum + tau[a] / s.stretches[a] * s.current_axes(i, a) * s.reference_axes(j, a);
      P(i, j) = sum;
    }
  }
  return P;
}

}  // namespace detail

/// Returns the isochoric stress P = d psi / dF.
template <std::size_t n, class T>
Tensor<T> first_piola_stress(const Ogden<n>& law, const Kinematics<T>& k) {
  const PrincipalStretches<T> s = principal_stretches(k);
  return detail::stress_from_principal(s, detail::kirchhoff_stresses(law, s));
}

/// Returns the isochoric stress and its tangent, which is exactly symmetric. In the dyads n_a (x) N_b the tangent has the
/// components
/// A_aabb = (d tau_a/d ln lambda_b - delta_ab tau_a) / (lambda_a lambda_b),
/// A_abab = q = (tau_a - tau_b)/(lambda_a^2 - lambda_b^2),
/// A_abba = q lambda_b/lambda_a - tau_b/(lambda_a lambda_b).
template <std::size_t n, class T>
StressAndTangent<T> stress_and_tangent(const Ogden<n>& law, const Kinematics<T>& k) {
  const PrincipalStretches<T> s = principal_stretches(k);
  const detail::PrincipalStresses<T> p = detail::principal_stresses<n, T>(law, s, k.isochoric_factor);
  std::array<std::array<Tensor<T>, 3>, 3> dyads;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) dyads[a][b] = detail::mixed_dyad(s, a, b);

  StressAndTangent<T> result;
  for (T& component : result.tangent.components) component = T(0.0);
  const auto add = [&](const T& factor, const Tensor<T>& left, const Tensor<T>& right) {
    for (std::size_t c = 0; c < 9; ++c)
      for (std::size_t d = c; d < 9; ++d)
        result.tangent(c, d) = result.tangent(c, d) + factor * left.components[c] * right.components[d];
  };
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      const T inverse = T(1.0) / (s.stretches[a] * s.stretches[b]);
      T normal = p.slopes(a, b);
      if (a == b) normal = normal - p.kirchhoff[a];
      const T normal_component = normal * inverse;
      add(normal_component, dyads[a][a], dyads[b][b]);
      if (a == b) continue;
      add(p.shears(a, b), dyads[a][b], dyads[a][b]);
      const T crossed = p.shears(a, b) * s.stretches[b] / s.stretches[a] - p.kirchhoff[b] * inverse;
      add(crossed, dyads[a][b], dyads[b][a]);
    }
  }
  detail::mirror(result.tangent);
  result.stress = detail::stress_from_principal(s, p.kirchhoff);
  return result;
}

/// Returns whether the law is valid at F. Check it before you use stress or energy.
template <std::size_t n>
LawStatus status_of(const Ogden<n>&, const Kinematics<double>& k) {
  return k.volume_ratio > 0.0 ? LawStatus::valid : LawStatus::inverted;
}

}  // namespace menger::materials
