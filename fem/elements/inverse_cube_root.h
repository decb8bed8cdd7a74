#pragma once

// For packs of doubles; included only by the kernels of an instruction set.

#include <cstdint>
#include <xsimd/xsimd.hpp>

namespace menger::fem::detail {

/// Returns x^(-1/3) for positive normal numbers, to about two units in the last place. For other numbers the result is some
/// finite number or NaN.
///
/// The upper half of a double is approximately a logarithm in fixed point. Minus a third of it therefore gives a first guess y
/// with |1 - x y^3| < 0.103. Two steps of y (1 - r)^(-1/3), r = 1 - x y^3, with the series up to r^3 reduce this to 2e-5 and
/// 5e-19.
template <class Pack>
Pack inverse_cube_root(const Pack& x) {
  using Bits = xsimd::batch<std::uint64_t, typename Pack::arch_type>;
  constexpr double two_to_52 = 4503599627370496.0;
  constexpr double guess_of_one = 1430186164.0;  // upper half of the guess for x with no bits; makes the largest |r| smallest
  const Bits upper_half = xsimd::bitwise_cast<Bits>(x) >> 32;
  // An integer n below 2^52 in the lower bits of the double 2^52 is the double 2^52 + n, and back.
  const Pack integer = xsimd::bitwise_cast<Pack>(upper_half | xsimd::bitwise_cast<Bits>(Pack(two_to_52))) - Pack(two_to_52);
  const Pack guess = xsimd::fma(integer, Pack(-1.0 / 3.0), Pack(two_to_52 + guess_of_one));
  Pack y = xsimd::bitwise_cast<Pack>(xsimd::bitwise_cast<Bits>(guess) << 32);
  for (int step = 0; step < 2; ++step) {
    const Pack r = xsimd::fnma(x * y, y * y, Pack(1.0));
    const Pack series = xsimd::fma(xsimd::fma(r, Pack(14.0 / 81.0), Pack(2.0 / 9.0)), r, Pack(1.0 / 3.0));
    y = xsimd::fma(y * r, series, y);
  }
  return y;
}

}  // namespace menger::fem::detail
