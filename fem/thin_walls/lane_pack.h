#pragma once

// Numbers of several elements at once, in registers. Included only by the kernels of an instruction set.

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "fem/thin_walls/lane_number.h"

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

template <class Batch>
struct Lanes<LanePack<Batch>> {
  using Number = typename Batch::value_type;
  static constexpr std::size_t count = Batch::size;
  static LanePack<Batch> load(const Number* numbers) { return LanePack<Batch>(Batch::load_aligned(numbers)); }
  static void store(const LanePack<Batch>& value, Number* numbers) { value.lanes().store_aligned(numbers); }
};

}  // namespace menger::fem::detail
