#pragma once

#include <cstddef>
#include <cstdint>

#include "fem/thin_walls/box_modes.h"

namespace menger::fem::detail {

/// A number of one of the 32 threads of a warp, which stand for the lanes of a register: the code of elements is written for a
/// pack of lanes, and here each thread has one of them. In memory the lanes of a warp are side by side.
template <class Real>
class WarpNumber {
 public:
  using Number = Real;

  WarpNumber() = default;
  __device__ explicit WarpNumber(double constant) : value_(static_cast<Real>(constant)) {}
  __device__ explicit WarpNumber(float number) : value_(static_cast<Real>(number)) {}
  [[nodiscard]] __device__ Real value() const { return value_; }

  friend __device__ WarpNumber operator+(const WarpNumber& a, const WarpNumber& b) { return WarpNumber(a.value_ + b.value_); }
  friend __device__ WarpNumber operator-(const WarpNumber& a, const WarpNumber& b) { return WarpNumber(a.value_ - b.value_); }
  friend __device__ WarpNumber operator*(const WarpNumber& a, const WarpNumber& b) { return WarpNumber(a.value_ * b.value_); }
  friend __device__ WarpNumber operator/(const WarpNumber& a, const WarpNumber& b) { return WarpNumber(a.value_ / b.value_); }
  friend __device__ WarpNumber operator-(const WarpNumber& a) { return WarpNumber(-a.value_); }
  friend __device__ bool operator<(const WarpNumber& a, const WarpNumber& b) { return a.value_ < b.value_; }
  friend __device__ bool operator>(const WarpNumber& a, const WarpNumber& b) { return a.value_ > b.value_; }

  friend __device__ WarpNumber select(bool mask, const WarpNumber& a, const WarpNumber& b) { return mask ? a : b; }
  friend __device__ WarpNumber fma(const WarpNumber& a, const WarpNumber& b, const WarpNumber& c) {
    return WarpNumber(::fma(a.value_, b.value_, c.value_));
  }
  friend __device__ WarpNumber fms(const WarpNumber& a, const WarpNumber& b, const WarpNumber& c) {
    return WarpNumber(::fma(a.value_, b.value_, -c.value_));
  }
  friend __device__ WarpNumber fnma(const WarpNumber& a, const WarpNumber& b, const WarpNumber& c) {
    return WarpNumber(::fma(-a.value_, b.value_, c.value_));
  }
  friend __device__ WarpNumber min(const WarpNumber& a, const WarpNumber& b) { return b.value_ < a.value_ ? b : a; }
  friend __device__ WarpNumber max(const WarpNumber& a, const WarpNumber& b) { return a.value_ < b.value_ ? b : a; }
  friend __device__ WarpNumber abs(const WarpNumber& a) { return WarpNumber(::fabs(a.value_)); }
  friend __device__ WarpNumber sqrt(const WarpNumber& a) { return WarpNumber(::sqrt(a.value_)); }
  friend __device__ WarpNumber exp(const WarpNumber& a) { return WarpNumber(::exp(a.value_)); }
  friend __device__ WarpNumber log(const WarpNumber& a) { return WarpNumber(::log(a.value_)); }
  friend __device__ bool any_positive(const WarpNumber& a) { return a.value_ > Real(0); }

 private:
  Real value_;
};

template <class Real>
struct Lanes<WarpNumber<Real>> {
  using Number = Real;
  static constexpr std::size_t count = 32;
  __device__ static WarpNumber<Real> load(const Real* numbers) { return WarpNumber<Real>(numbers[threadIdx.x % count]); }
  __device__ static void store(const WarpNumber<Real>& value, Real* numbers) { numbers[threadIdx.x % count] = value.value(); }
  __device__ static double own(const WarpNumber<Real>& value) { return static_cast<double>(value.value()); }
};

/// Corners lie one after the other, each with its lanes side by side: corner c of lane l at 32 c + l. Forces have their three
/// components apart in the same way. No register is addressed by the axis, which is known only at run time: it would have to lie
/// in memory.
template <class Real>
struct BoxMemory<WarpNumber<Real>> {
  using T = WarpNumber<Real>;
  static constexpr std::size_t width = Lanes<T>::count;

  __device__ static BoxModes<T> modes(const std::uint32_t* first_components, std::size_t first_axis, const Real* values) {
    BoxModes<T> modes;
    const std::uint32_t* own = first_components + threadIdx.x % width;
    std::uint32_t first[8];
    for (std::size_t corner = 0; corner < 8; ++corner) first[corner] = own[width * corner];
    for (std::size_t local = 0; local < 3; ++local) {
      const std::size_t i = component(first_axis, local);
      CornerValues<T> u;
      for (std::size_t corner = 0; corner < 8; ++corner) u[corner] = T(values[first[corner] + i]);
      set_modes(u, local, modes);
    }
    return modes;
  }

  template <bool has_resultant>
  __device__ static void store(const BoxModes<T>& modes, std::size_t first_axis, Real* slots) {
    for (std::size_t local = 0; local < 3; ++local) {
      CornerValues<T> f;
      add_up<has_resultant>(modes, local, f);
      Real* own = slots + width * component(first_axis, local) + threadIdx.x % width;
      for (std::size_t corner = 0; corner < 8; ++corner) own[3 * width * corner] = f[corner].value();
    }
  }

 private:
  __device__ static std::size_t component(std::size_t first_axis, std::size_t local) {
    const std::size_t i = first_axis + local;
    return i < 3 ? i : i - 3;
  }
};

}  // namespace menger::fem::detail
