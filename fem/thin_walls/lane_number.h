#pragma once

// Numbers of one element, or of several at once: what the code of elements is written for. See LanePack for registers, WarpNumber
// for the threads of a graphics processor.

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "io/device/host_device.h"
#include "materials/laws/accurate_functions.h"

namespace menger::fem::detail {

/// How numbers of lanes lie in memory. A plain number is one lane.
template <class T>
struct Lanes {
  using Number = T;
  static constexpr std::size_t count = 1;
  MENGER_HOST_DEVICE static T load(const Number* numbers) { return *numbers; }
  MENGER_HOST_DEVICE static void store(const T& value, Number* numbers) { *numbers = value; }
  /// The number of the lane that this thread computes.
  MENGER_HOST_DEVICE static double own(const T& value) { return static_cast<double>(value); }
};

template <class T>
using NumberOf = typename Lanes<T>::Number;

// The same for plain numbers; templates, so that no instruction set but the caller's gets into them.
template <class T>
requires std::is_floating_point_v<T> MENGER_HOST_DEVICE T fma(const T& a, const T& b, const T& c) { return std::fma(a, b, c); }
template <class T>
requires std::is_floating_point_v<T> MENGER_HOST_DEVICE T fms(const T& a, const T& b, const T& c) { return std::fma(a, b, -c); }
template <class T>
requires std::is_floating_point_v<T> MENGER_HOST_DEVICE T fnma(const T& a, const T& b, const T& c) { return std::fma(-a, b, c); }
template <class T>
requires std::is_floating_point_v<T> MENGER_HOST_DEVICE T min(const T& a, const T& b) { return b < a ? b : a; }
template <class T>
requires std::is_floating_point_v<T> MENGER_HOST_DEVICE T max(const T& a, const T& b) { return a < b ? b : a; }
template <class T>
requires std::is_floating_point_v<T> MENGER_HOST_DEVICE bool any_positive(const T& a) { return a > T(0); }

using materials::select;
using std::abs;
using std::exp;
using std::log;
using std::sqrt;

/// Sums of lanes over many batches, in double precision.
template <class T>
class LaneSums {
 public:
  MENGER_HOST_DEVICE void add(const T& values) {
    alignas(64) std::array<NumberOf<T>, Lanes<T>::count> lanes;
    Lanes<T>::store(values, lanes.data());
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) sums_[lane] += static_cast<double>(lanes[lane]);
  }
  [[nodiscard]] MENGER_HOST_DEVICE double total() const {
    std::array<double, Lanes<T>::count> sums = sums_;
    for (std::size_t half = sums.size() / 2; half > 0; half /= 2)
      for (std::size_t lane = 0; lane < half; ++lane) sums[lane] += sums[lane + half];
    return sums[0];
  }

 private:
  std::array<double, Lanes<T>::count> sums_{};
};

/// Three components of a pack each, along local or global axes.
template <class T>
using Vector3 = std::array<T, 3>;

template <class T>
MENGER_HOST_DEVICE T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return fma(a[0], b[0], fma(a[1], b[1], a[2] * b[2]));
}

template <class T>
MENGER_HOST_DEVICE Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {fms(a[1], b[2], a[2] * b[1]), fms(a[2], b[0], a[0] * b[2]), fms(a[0], b[1], a[1] * b[0])};
}

template <class T>
MENGER_HOST_DEVICE Vector3<T> scaled(const T& factor, const Vector3<T>& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

/// sum + factor a, in place.
template <class T>
MENGER_HOST_DEVICE void add(Vector3<T>& sum, const T& factor, const Vector3<T>& a) {
  for (std::size_t i = 0; i < 3; ++i) sum[i] = fma(factor, a[i], sum[i]);
}

/// 1 where x is above a limit, -1 elsewhere, also for what is not a number.
template <class T>
MENGER_HOST_DEVICE T sign_above(const T& x, const T& limit) {
  return select(x > limit, T(1.0), T(-1.0));
}

}  // namespace menger::fem::detail
