#pragma once

// Numbers of several elements at once. Included only by the kernels of an instruction set.

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <xsimd/xsimd.hpp>

#include "materials/laws/accurate_functions.h"

namespace menger::fem::detail {

/// A register of numbers, one for each lane. It takes constants as doubles, so that formulas and the laws of materials are
/// written once for every number type: `T(0.5)`.
template <class Batch>
class LanePack {
 public:
  using Number = typename Batch::value_type;
  using Mask = typename Batch::batch_bool_type;
  static constexpr std::size_t size = Batch::size;

  LanePack() = default;
  explicit LanePack(double constant) : lanes_(static_cast<Number>(constant)) {}
  explicit LanePack(const Batch& lanes) : lanes_(lanes) {}
  [[nodiscard]] const Batch& lanes() const { return lanes_; }

  friend LanePack operator+(const LanePack& a, const LanePack& b) { return LanePack(a.lanes_ + b.lanes_); }
  friend LanePack operator-(const LanePack& a, const LanePack& b) { return LanePack(a.lanes_ - b.lanes_); }
  friend LanePack operator*(const LanePack& a, const LanePack& b) { return LanePack(a.lanes_ * b.lanes_); }
  friend LanePack operator/(const LanePack& a, const LanePack& b) { return LanePack(a.lanes_ / b.lanes_); }
  friend LanePack operator-(const LanePack& a) { return LanePack(-a.lanes_); }
  friend Mask operator<(const LanePack& a, const LanePack& b) { return a.lanes_ < b.lanes_; }
  friend Mask operator>(const LanePack& a, const LanePack& b) { return a.lanes_ > b.lanes_; }

  friend LanePack select(const Mask& mask, const LanePack& a, const LanePack& b) {
    return LanePack(xsimd::select(mask, a.lanes_, b.lanes_));
  }
  friend LanePack fma(const LanePack& a, const LanePack& b, const LanePack& c) {
    return LanePack(xsimd::fma(a.lanes_, b.lanes_, c.lanes_));
  }
  friend LanePack fms(const LanePack& a, const LanePack& b, const LanePack& c) {
    return LanePack(xsimd::fms(a.lanes_, b.lanes_, c.lanes_));
  }
  friend LanePack fnma(const LanePack& a, const LanePack& b, const LanePack& c) {
    return LanePack(xsimd::fnma(a.lanes_, b.lanes_, c.lanes_));
  }
  friend LanePack min(const LanePack& a, const LanePack& b) { return LanePack(xsimd::min(a.lanes_, b.lanes_)); }
  friend LanePack max(const LanePack& a, const LanePack& b) { return LanePack(xsimd::max(a.lanes_, b.lanes_)); }
  friend LanePack abs(const LanePack& a) { return LanePack(xsimd::abs(a.lanes_)); }
  friend LanePack sqrt(const LanePack& a) { return LanePack(xsimd::sqrt(a.lanes_)); }
  friend LanePack exp(const LanePack& a) { return LanePack(xsimd::exp(a.lanes_)); }
  friend LanePack log(const LanePack& a) { return LanePack(xsimd::log(a.lanes_)); }
  friend bool any_positive(const LanePack& a) { return xsimd::any(a.lanes_ > Batch(Number(0))); }

 private:
  Batch lanes_;
};

/// How numbers of lanes lie in memory. A plain number is one lane.
template <class T>
struct Lanes {
  using Number = T;
  static constexpr std::size_t count = 1;
  static T load(const Number* numbers) { return *numbers; }
  static void store(const T& value, Number* numbers) { *numbers = value; }
};

template <class Batch>
struct Lanes<LanePack<Batch>> {
  using Number = typename Batch::value_type;
  static constexpr std::size_t count = Batch::size;
  static LanePack<Batch> load(const Number* numbers) { return LanePack<Batch>(Batch::load_aligned(numbers)); }
  static void store(const LanePack<Batch>& value, Number* numbers) { value.lanes().store_aligned(numbers); }
};

template <class T>
using NumberOf = typename Lanes<T>::Number;

// The same for plain numbers; templates, so that no instruction set but the caller's gets into them.
template <class T>
requires std::is_floating_point_v<T> T fma(const T& a, const T& b, const T& c) { return std::fma(a, b, c); }
template <class T>
requires std::is_floating_point_v<T> T fms(const T& a, const T& b, const T& c) { return std::fma(a, b, -c); }
template <class T>
requires std::is_floating_point_v<T> T fnma(const T& a, const T& b, const T& c) { return std::fma(-a, b, c); }
template <class T>
requires std::is_floating_point_v<T> T min(const T& a, const T& b) { return b < a ? b : a; }
template <class T>
requires std::is_floating_point_v<T> T max(const T& a, const T& b) { return a < b ? b : a; }
template <class T>
requires std::is_floating_point_v<T>
bool any_positive(const T& a) { return a > T(0); }

using materials::select;
using std::abs;
using std::exp;
using std::log;
using std::sqrt;

/// Sums of lanes over many batches, in double precision.
template <class T>
class LaneSums {
 public:
  void add(const T& values) {
    alignas(64) std::array<NumberOf<T>, Lanes<T>::count> lanes;
    Lanes<T>::store(values, lanes.data());
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) sums_[lane] += static_cast<double>(lanes[lane]);
  }
  [[nodiscard]] double total() const {
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
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return fma(a[0], b[0], fma(a[1], b[1], a[2] * b[2]));
}

template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {fms(a[1], b[2], a[2] * b[1]), fms(a[2], b[0], a[0] * b[2]), fms(a[0], b[1], a[1] * b[0])};
}

template <class T>
Vector3<T> scaled(const T& factor, const Vector3<T>& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

/// sum + factor a, in place.
template <class T>
void add(Vector3<T>& sum, const T& factor, const Vector3<T>& a) {
  for (std::size_t i = 0; i < 3; ++i) sum[i] = fma(factor, a[i], sum[i]);
}

/// 1 where x is above a limit, -1 elsewhere, also for what is not a number.
template <class T>
T sign_above(const T& x, const T& limit) {
  return select(x > limit, T(1.0), T(-1.0));
}

}  // namespace menger::fem::detail
