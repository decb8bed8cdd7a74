#pragma once

// Energy of a block at its centre, for every law.

#include <array>
#include <cstddef>
#include <variant>

#include "fem/thin_walls/lane_number.h"
#include "materials/laws/hyperelastic_law.h"
#include "materials/laws/ogden_response.h"

namespace menger::fem::detail {

/// F = (f1, f2, f3) at the centre of a block.
template <class T>
struct BlockGradient {
  std::array<Vector3<T>, 3> columns;    ///< f_i
  std::array<Vector3<T>, 3> cofactors;  ///< columns of cof F
  T ratio;                              ///< J
  T ratio_excess;                       ///< J - 1
  T square_excess;                      ///< I1 - 3 - 2 (J - 1)
};

/// P = F S + b cof F.
template <class T>
struct BlockResponse {
  std::array<T, 6> stress;  ///< S: 11, 22, 33, 23, 13, 12, Pa
  T by_cofactor;            ///< b, Pa
  T energy;                 ///< J/m^3
  T admissible;             ///< 1, or -1 where the law has no value
};

/// I1 - 3 - 2 ln J, the sum of l^2 - 1 - ln l^2 over the principal stretches l: 0 at rest, positive elsewhere.
template <class T>
MENGER_HOST_DEVICE T first_block_excess(const BlockGradient<T>& F) {
  return fma(T(2.0), materials::log_remainder<T>(F.ratio_excess), F.square_excess);
}

/// Energies of blocks. The invariants' excesses are those of a body that can change its volume, y1 = I1 - 3 - 2 ln J and
/// y2 = I2 - 3 - 4 ln J - 2 (J - 1)^2 with I1, I2 of F itself, in place of I1 - 3 and I2 - 3 of the isochoric deformation; they
/// are the same where J = 1. No stress acts at rest, the moduli of small strain are mu and lambda for every law, nothing needs a
/// cube root, and the logarithm keeps a block from being crushed. The law of volume, lambda/2 (J - 1)^2, is added to it by the
/// element. A neo-Hookean block has mu/2 (I1 - 3) - mu ln J.
template <class T>
MENGER_HOST_DEVICE BlockResponse<T> block_answer(const materials::NeoHookean& law, const BlockGradient<T>& F) {
  const T mu = T(law.shear_modulus_Pa);
  const T zero = T(0.0);
  return {{mu, mu, mu, zero, zero, zero}, -(mu / F.ratio), T(0.5) * mu * first_block_excess(F), T(1.0)};
}

/// P = 2 W1 (F - F^-T) + W2 (2 (I1 F - F C) - 4 F^-T - 4 (J - 1) cof F).
template <materials::InvariantLaw Law, class T>
MENGER_HOST_DEVICE BlockResponse<T> block_answer(const Law& law, const BlockGradient<T>& F) {
  const T y1 = first_block_excess(F);
  const auto& f = F.columns;
  T y2(0.0);
  std::array<T, 6> C;
  T first(0.0);
  if constexpr (Law::uses_second_invariant) {
    C = {dot(f[0], f[0]), dot(f[1], f[1]), dot(f[2], f[2]), dot(f[1], f[2]), dot(f[0], f[2]), dot(f[0], f[1])};
    first = C[0] + C[1] + C[2];
    T second(0.0);  // I2 is |cof F|^2
    for (const Vector3<T>& n : F.cofactors) second = second + dot(n, n);
    y2 = (second - T(3.0)) - T(4.0) * (F.ratio_excess - materials::log_remainder<T>(F.ratio_excess));
    y2 = fnma(T(2.0) * F.ratio_excess, F.ratio_excess, y2);
  }
  const materials::InvariantEnergy<T> w = law.energy(y1, y2);
  const T zero = T(0.0);
  const T twice = T(2.0) * w.d1;
  BlockResponse<T> response{
      {twice, twice, twice, zero, zero, zero}, -(twice / F.ratio), w.energy, select(law.is_within_limit(y1), T(1.0), T(-1.0))};
  if constexpr (Law::uses_second_invariant) {
    const T by_second = T(2.0) * w.d2;
    for (std::size_t c = 0; c < 6; ++c) response.stress[c] = fnma(by_second, C[c], response.stress[c]);
    for (std::size_t c = 0; c < 3; ++c) response.stress[c] = fma(by_second, first, response.stress[c]);
    response.by_cofactor = fnma(T(2.0) * by_second, T(1.0) / F.ratio + F.ratio_excess, response.by_cofactor);
  }
  return response;
}

/// Ogden's law for a body that can change its volume: sum mu_p/alpha_p (l1^alpha + l2^alpha + l3^alpha - 3 - alpha ln J).
template <std::size_t n, class T>
MENGER_HOST_DEVICE BlockResponse<T> block_answer(const materials::Ogden<n>& law, const BlockGradient<T>& F) {
  const auto& f = F.columns;
  const T C12 = dot(f[0], f[1]);
  const T C13 = dot(f[0], f[2]);
  const T C23 = dot(f[1], f[2]);
  const materials::PrincipalAxes<T> C =
      materials::principal_axes<T>({{dot(f[0], f[0]), C12, C13, C12, dot(f[1], f[1]), C23, C13, C23, dot(f[2], f[2])}});
  std::array<T, 3> logarithms;
  std::array<T, 3> forces{T(0.0), T(0.0), T(0.0)};
  T energy(0.0);
  for (std::size_t a = 0; a < 3; ++a) logarithms[a] = T(0.5) * log(C.values[a]);
  T pressure(0.0);
  for (const materials::OgdenTerm& term : law.terms) {
    const T mu = T(term.modulus_Pa);
    pressure = pressure + mu;
    for (std::size_t a = 0; a < 3; ++a) {
      const T exponent = T(term.exponent) * logarithms[a];
      forces[a] = fma(mu, exp(exponent), forces[a]);
      energy = fma(T(term.modulus_Pa / term.exponent), materials::exp_remainder<T>(exponent), energy);
    }
  }
  BlockResponse<T> response{
      {T(0.0), T(0.0), T(0.0), T(0.0), T(0.0), T(0.0)}, -(pressure / F.ratio), energy, sign_above(F.ratio, T(0.0))};
  for (std::size_t a = 0; a < 3; ++a) {
    const T value = forces[a] / C.values[a];
    const auto& N = C.axes;
    for (std::size_t c = 0; c < 3; ++c) response.stress[c] = fma(value * N(c, a), N(c, a), response.stress[c]);
    response.stress[3] = fma(value * N(1, a), N(2, a), response.stress[3]);
    response.stress[4] = fma(value * N(0, a), N(2, a), response.stress[4]);
    response.stress[5] = fma(value * N(0, a), N(1, a), response.stress[5]);
  }
  return response;
}

template <class T>
using BlockFunction = void (*)(const void* law, const BlockGradient<T>& F, BlockResponse<T>& response);

template <class Law, class T>
MENGER_HOST_DEVICE void answer_block(const void* law, const BlockGradient<T>& F, BlockResponse<T>& response) {
  response = block_answer(*static_cast<const Law*>(law), F);
}

template <class T, class... Laws>
constexpr std::array<BlockFunction<T>, sizeof...(Laws)> block_functions(const std::variant<Laws...>*) {
  return {answer_block<Laws, T>...};
}

}  // namespace menger::fem::detail
