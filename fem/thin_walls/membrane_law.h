#pragma once

// Energy of a thin layer that is free of stress across itself, for every law.

#include <array>
#include <cstddef>
#include <type_traits>
#include <variant>

#include "fem/thin_walls/lane_number.h"
#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/ogden_response.h"

namespace menger::fem::detail {

/// The metric of a layer: a = f1.f1, b = f2.f2, c = f1.f2 with the in-plane columns f1, f2 of F. Excesses over rest are kept, so
/// that nothing cancels at small strain.
template <class T>
struct PlaneMetric {
  T a_excess;  ///< a - 1
  T b_excess;  ///< b - 1
  T c;
  T area_excess;  ///< d - 1, where d = a b - c^2 is the square of the area ratio
  T inverse;      ///< 1 / d
};

template <class T>
MENGER_HOST_DEVICE PlaneMetric<T> plane_metric(const T& a_excess, const T& b_excess, const T& c) {
  const T area_excess = (a_excess + b_excess) + fms(a_excess, b_excess, c * c);
  return {a_excess, b_excess, c, area_excess, T(1.0) / (T(1.0) + area_excess)};
}

/// Second Piola-Kirchhoff stress in the plane, Pa: the forces on f1 and f2 are s11 f1 + s12 f2 and s12 f1 + s22 f2.
template <class T>
struct PlaneStress {
  T s11 = T(0.0);
  T s22 = T(0.0);
  T s12 = T(0.0);
};

/// The response of a law to a metric.
template <class T>
struct MembraneResponse {
  PlaneStress<T> stress;
  T energy;      ///< J/m^3
  T admissible;  ///< 1, or -1 where the law has no value
};

/// A neo-Hookean layer: the minimum of mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J - 1)^2 over the stretch across it, exact to first
/// order in mu / kappa: mu/2 (a + b + 1/d - 3) - mu^2 Q^2 / (2 kappa) with Q = 2/(3 d) - (a + b)/3. It has no lower bound where
/// the area ratio falls below 0.13.
template <class T>
MENGER_HOST_DEVICE MembraneResponse<T> membrane_answer(const materials::NeoHookean& law, double bulk_modulus_Pa,
                                                       const PlaneMetric<T>& m) {
  const T mu = T(law.shear_modulus_Pa);
  const T sum = m.a_excess + m.b_excess;
  const T d = T(1.0) + m.area_excess;
  const T third = m.inverse * T(-1.0 / 3.0);
  const T Q = third * fma(d, sum, T(2.0) * m.area_excess);
  const T softening = Q * T(law.shear_modulus_Pa / bulk_modulus_Pa * (2.0 / 3.0));
  const T inverse_square = m.inverse * m.inverse;
  const T both = fma(m.area_excess, m.area_excess, T(2.0) * m.area_excess);  // d^2 - 1
  const T slope = inverse_square * fma(softening, T(2.0), T(-1.0));          // what multiplies b in s11
  MembraneResponse<T> response;
  // 1 - b/d^2 without cancellation, and softening (1 + 2 b/d^2)
  const T doubled = T(2.0) * softening * inverse_square;
  response.stress.s11 = mu * fma(inverse_square, both - m.b_excess, fma(doubled, m.b_excess, softening + doubled));
  response.stress.s22 = mu * fma(inverse_square, both - m.a_excess, fma(doubled, m.a_excess, softening + doubled));
  response.stress.s12 = -(mu * slope * m.c);
  // a + b + 1/d - 3 = ((a + b - 2) (d - 1) + (a + b - 2) - (d - 1)) / d, where the last two are c^2 - (a - 1)(b - 1)
  const T excess = m.inverse * fma(sum, m.area_excess, fms(m.c, m.c, m.a_excess * m.b_excess));
  response.energy = mu * T(0.5) * fms(Q, Q * T(-law.shear_modulus_Pa / bulk_modulus_Pa), -excess);
  response.admissible = T(1.0);
  return response;
}

/// When the change of a stretch in Newton's method says that its square is below rounding.
template <class T>
inline constexpr double last_newton_step = std::is_same_v<NumberOf<T>, float> ? 1e-4 : 1e-8;

/// Newton's method for the stretch across a layer, lane by lane: a lane that has arrived stays where it is, so that it does not
/// depend on its neighbours. @param derivatives of (x, slope, curvature): of the energy by x @return 1 where it has arrived, else
/// -1
template <class T, class Derivatives>
MENGER_HOST_DEVICE T minimise(T& x, const Derivatives& derivatives) {
  constexpr int most_steps = 30;
  constexpr double longest_step = 0.1;
  T active(1.0);
  T arrived(1.0);
  for (int n = 0; n < most_steps && any_positive(active); ++n) {
    T slope;
    T curvature;
    derivatives(x, slope, curvature);
    const T step = min(max(-slope / curvature, T(-longest_step)), T(longest_step));
    x = fma(active, step, x);
    arrived = select(active > T(0.0), sign_above(curvature, T(0.0)), arrived);
    active = select(abs(step) > T(last_newton_step<T>), active, T(0.0));
  }
  return select(active > T(0.0), T(-1.0), arrived);
}

/// A layer of a law in the invariants, whose stretch across it is solved for: the minimum of W + kappa/2 (J - 1)^2 over s =
/// J^(1/3), where I1 = (a + b) s^-2 + s^4 / d and I2 = d s^-4 + s^2 (a + b) / d. The stress follows from the energy at the s that
/// was found, because the energy does not change with s there. Bounded also where a law stiffens, as the first order in mu /
/// kappa is not.
template <materials::InvariantLaw Law, class T>
MENGER_HOST_DEVICE MembraneResponse<T> membrane_answer(const Law& law, double bulk_modulus_Pa, const PlaneMetric<T>& m) {
  const T sum = m.a_excess + m.b_excess;
  const T A = T(2.0) + sum;
  const T B = m.inverse;
  const T d = T(1.0) + m.area_excess;
  const T mixed = fms(m.a_excess, m.b_excess, m.c * m.c);
  const T x1_at_rest = B * fms(sum, m.area_excess, mixed);  // of J = 1
  // d + (a + b)/d - 3 is the same plus (d - 1)((d - 1) - (a + b - 2)) / d
  const T x2_at_rest = fma(m.area_excess * B, m.area_excess - sum, x1_at_rest);
  const T kappa = T(bulk_modulus_Pa);
  struct Point {
    T first, second, cube_excess, inverse_square, first_slope, second_slope, first_curvature, second_curvature;
  };
  const auto at = [&](const T& s) {
    const T z = s - T(1.0);
    const T square = s * s;
    const T i2 = T(1.0) / square;
    const T down = -(z * (s + T(1.0)) * i2);            // s^-2 - 1
    const T up = z * (s + T(1.0)) * (square + T(1.0));  // s^4 - 1
    Point p;
    p.first = fma(A, down, fma(B, up, x1_at_rest));
    p.second = fma(d, down * (i2 + T(1.0)), fma(A * B, z * (s + T(1.0)), x2_at_rest));
    p.cube_excess = z * fma(z, z + T(3.0), T(3.0));  // s^3 - 1
    p.inverse_square = i2;
    const T i3 = i2 * i2 * s;
    const T i4 = i2 * i2;
    p.first_slope = fms(T(4.0) * B, square * s, T(2.0) * A * i3);
    p.first_curvature = fma(T(12.0) * B, square, T(6.0) * A * i4);
    p.second_slope = fms(T(2.0) * A * B, s, T(4.0) * d * i4 * i2 * s);
    p.second_curvature = fma(T(20.0) * d, i4 * i2, T(2.0) * A * B);
    return p;
  };
  T s(1.0);
  const T arrived = minimise(s, [&](const T& x, T& slope, T& curvature) {
    const Point p = at(x);
    const materials::InvariantEnergy<T> w = law.energy(p.first, p.second);
    const T square = x * x;
    slope = fma(w.d1, p.first_slope, T(3.0) * kappa * square * p.cube_excess);
    curvature = fma(w.d1, p.first_curvature, w.d11 * p.first_slope * p.first_slope);
    curvature = fma(kappa, fma(T(6.0) * x, p.cube_excess, T(9.0) * square * square), curvature);
    if constexpr (Law::uses_second_invariant) {
      slope = fma(w.d2, p.second_slope, slope);
      const T by_second = fma(T(2.0) * w.d12, p.first_slope, w.d22 * p.second_slope);
      curvature = fma(by_second, p.second_slope, fma(w.d2, p.second_curvature, curvature));
    }
  });

  const Point p = at(s);
  const materials::InvariantEnergy<T> w = law.energy(p.first, p.second);
  const T fourth = s * s * s * s;
  const T B2 = B * B;
  // s^-2 - s^4 b / d^2, in excesses
  const T both = fma(m.area_excess, m.area_excess, T(2.0) * m.area_excess);
  const T down = p.inverse_square - T(1.0);
  const T up = fourth - T(1.0);
  const auto first_part = [&](const T& excess) { return fma(B2, both - excess, fms(up * B2, -(T(1.0) + excess), -down)); };
  MembraneResponse<T> response;
  const T twice = T(2.0) * w.d1;
  response.stress.s11 = twice * first_part(m.b_excess);
  response.stress.s22 = twice * first_part(m.a_excess);
  response.stress.s12 = twice * fourth * B2 * m.c;
  if constexpr (Law::uses_second_invariant) {
    const T square = s * s;
    const T i4 = p.inverse_square * p.inverse_square;
    const T by_other = fms(square * A, -B2, -i4);  // s^-4 - s^2 (a + b) / d^2
    const T doubled = T(2.0) * w.d2;
    response.stress.s11 = fma(doubled, fma(T(1.0) + m.b_excess, by_other, square * B), response.stress.s11);
    response.stress.s22 = fma(doubled, fma(T(1.0) + m.a_excess, by_other, square * B), response.stress.s22);
    response.stress.s12 = fnma(doubled * by_other, m.c, response.stress.s12);
  }
  response.energy = fma(T(0.5) * kappa * p.cube_excess, p.cube_excess, w.energy);
  response.admissible = select(law.is_within_limit(p.first), arrived, T(-1.0));
  return response;
}

/// A layer of Ogden's law, in its principal stretches; the stretch across it is solved for as above, by t = ln(J)/3.
template <std::size_t n, class T>
MENGER_HOST_DEVICE MembraneResponse<T> membrane_answer(const materials::Ogden<n>& law, double bulk_modulus_Pa,
                                                       const PlaneMetric<T>& m) {
  const T half_difference = T(0.5) * (m.a_excess - m.b_excess);
  const T radius = sqrt(fma(half_difference, half_difference, m.c * m.c));
  const T v1 = T(1.0) + fma(T(0.5), m.a_excess + m.b_excess, radius);  // the larger eigenvalue of the metric
  const T d = T(1.0) + m.area_excess;
  const T v2 = d / v1;
  const T log1 = T(0.5) * log(v1);
  const T log2 = T(0.5) * log(v2);
  const T kappa = T(bulk_modulus_Pa);
  std::array<std::array<T, 3>, n> at_rest;  // lambda^alpha at J = 1
  for (std::size_t p = 0; p < n; ++p) {
    const T alpha = T(law.terms[p].exponent);
    at_rest[p] = {exp(alpha * log1), exp(alpha * log2), exp(-(alpha * (log1 + log2)))};
  }
  T t(0.0);
  const T arrived = minimise(t, [&](const T& x, T& slope, T& curvature) {
    const T ratio = exp(T(3.0) * x);
    slope = T(3.0) * kappa * ratio * (ratio - T(1.0));
    curvature = T(9.0) * kappa * ratio * fms(T(2.0), ratio, T(1.0));
    for (std::size_t p = 0; p < n; ++p) {
      const T alpha = T(law.terms[p].exponent);
      const T up = exp(alpha * x);
      const T in_plane = (at_rest[p][0] + at_rest[p][1]) / up;
      const T across = at_rest[p][2] * up * up;
      const T mu = T(law.terms[p].modulus_Pa);
      slope = fma(mu, fms(T(2.0), across, in_plane), slope);
      curvature = fma(mu * alpha, fma(T(4.0), across, in_plane), curvature);
    }
  });

  const T e1 = log1 - t;
  const T e2 = log2 - t;
  const T e3 = -(e1 + e2);
  const T ratio_excess = exp(T(3.0) * t) - T(1.0);
  const T inverse_fourth = exp(T(-4.0) * t);
  T across(0.0);    // sum of mu l3^alpha
  T mean(0.0);      // of mu l^alpha / v in the plane
  T quotient(0.0);  // of their difference and that of v
  T energy = T(0.5) * kappa * ratio_excess * ratio_excess;
  for (const materials::OgdenTerm& term : law.terms) {
    const T mu = T(term.modulus_Pa);
    const T alpha = T(term.exponent);
    const T w1 = exp(alpha * e1);
    const T w2 = exp(alpha * e2);
    across = fma(mu, exp(alpha * e3), across);
    mean = fma(T(0.5) * mu, w1 / v1 + w2 / v2, mean);
    const T power = materials::detail::power_difference_quotient<T>(e1, e2, 0.5 * term.exponent - 1.0);
    quotient = fma(mu * inverse_fourth, power, quotient);
    const T sum = materials::exp_remainder<T>(alpha * e1) + materials::exp_remainder<T>(alpha * e2) +
                  materials::exp_remainder<T>(alpha * e3);
    energy = fma(T(term.modulus_Pa / term.exponent), sum, energy);
  }
  const T by_inverse = across * m.inverse;
  MembraneResponse<T> response;
  response.stress.s11 = fma(quotient, half_difference, fnma(by_inverse, T(1.0) + m.b_excess, mean));
  response.stress.s22 = fnma(quotient, half_difference, fnma(by_inverse, T(1.0) + m.a_excess, mean));
  response.stress.s12 = m.c * (quotient + by_inverse);
  response.energy = energy;
  response.admissible = select(m.area_excess > T(-1.0), arrived, T(-1.0));
  return response;
}

template <class T>
using MembraneFunction = void (*)(const void* law, double bulk_modulus_Pa, const PlaneMetric<T>& metric,
                                  MembraneResponse<T>& response);

template <class Law, class T>
MENGER_HOST_DEVICE void answer_membrane(const void* law, double bulk_modulus_Pa, const PlaneMetric<T>& metric,
                                        MembraneResponse<T>& response) {
  response = membrane_answer(*static_cast<const Law*>(law), bulk_modulus_Pa, metric);
}

template <class T, class... Laws>
constexpr std::array<MembraneFunction<T>, sizeof...(Laws)> membrane_functions(const std::variant<Laws...>*) {
  return {answer_membrane<Laws, T>...};
}

}  // namespace menger::fem::detail
