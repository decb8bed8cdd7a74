#pragma once

#include <cmath>

#include "io/device/host_device.h"

namespace menger::materials {

/// Chooses between two values that are both computed, as SIMD packs require. Packs have a function of their own, which is found
/// through their namespace.
MENGER_HOST_DEVICE inline double select(bool condition, double first, double second) { return condition ? first : second; }
MENGER_HOST_DEVICE inline float select(bool condition, float first, float second) { return condition ? first : second; }
template <class T>
MENGER_HOST_DEVICE T select(bool condition, const T& first, const T& second) {
  return condition ? first : second;
}

/// Returns x - ln(1 + x) for x > -1, with full relative accuracy near 0, where it is x^2/2.
template <class T>
MENGER_HOST_DEVICE T log_remainder(const T& x) {
  using std::log;
  // With s = x / (2 + x), ln(1 + x) = 2 artanh(s) and x - 2 s = x s.
  const T s = x / (T(2.0) + x);
  const T s2 = s * s;
  T sum = T(1.0 / 19.0);
  for (int n = 17; n >= 3; n -= 2) sum = sum * s2 + T(1.0 / n);
  const T series = x * s - T(2.0) * s * s2 * sum;
  const T direct = x - log(T(1.0) + x);
  return select(s2 < T(0.02), series, direct);
}

/// Returns sinh(x) / x - 1, with full relative accuracy near 0, where it is x^2/6.
template <class T>
MENGER_HOST_DEVICE T sinhc_excess(const T& x) {
  using std::exp;
  const T x2 = x * x;
  T sum(1.0);
  for (int n = 18; n >= 4; n -= 2) sum = T(1.0) + sum * x2 * T(1.0 / (n * (n + 1)));
  const T series = sum * x2 * T(1.0 / 6.0);
  const auto is_small = x2 < T(1.0);
  const T divisor = select(is_small, T(1.0), x);  // must not be zero even where it is not used
  const T grown = exp(divisor);
  const T direct = (grown - T(1.0) / grown) / (T(2.0) * divisor) - T(1.0);
  return select(is_small, series, direct);
}

/// Returns exp(x) - 1 - x, with full relative accuracy near 0, where it is x^2/2.
template <class T>
MENGER_HOST_DEVICE T exp_remainder(const T& x) {
  using std::exp;
  const T half = x * T(0.5);
  const T half_sinhc = sinhc_excess<T>(half) + T(1.0);
  const T near = T(0.5) * x * x * half_sinhc * half_sinhc + x * sinhc_excess<T>(x);  // (cosh x - 1) + (sinh x - x)
  const T direct = exp(x) - T(1.0) - x;
  return select(x * x < T(1.0), near, direct);
}

}  // namespace menger::materials
