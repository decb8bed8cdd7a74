#pragma once

#include <cmath>
#include <cstdint>

#include "io/device/host_device.h"

/// Inlines everything that a kernel calls, which makes small bodies a third faster. Switched off with the address sanitizer,
/// because its checks make the compiler take minutes for each kernel.
#if defined(__SANITIZE_ADDRESS__)
#define MENGER_INLINED_WHOLE
#else
#define MENGER_INLINED_WHOLE [[gnu::flatten]]
#endif

namespace menger::voxel {

/// Describes a number type that the laws of this folder are written for: double, float, or a SIMD pack of them with one beam or
/// voxel per lane (see pack.h).
///
/// A law is a template over T. It uses only +, -, *, /, comparisons, sqrt, abs and the functions below, so that one source serves
/// all number types. None of them fuses a multiplication with an addition: a lane of a pack and a scalar give the same bytes.
template <class T>
struct NumberTraits {
  using Real = T;
  using Mask = bool;
  static constexpr int width = 1;
};

template <class T>
using RealOf = typename NumberTraits<T>::Real;
template <class T>
using MaskOf = typename NumberTraits<T>::Mask;

/// Returns a where the mask holds and b elsewhere. It does not multiply, so that a NaN in the value not chosen has no effect.
/// Always inlined, because a copy compiled for one instruction set must not be linked into code for another.
[[gnu::always_inline]] MENGER_HOST_DEVICE inline double select(bool mask, double a, double b) { return mask ? a : b; }
[[gnu::always_inline]] MENGER_HOST_DEVICE inline float select(bool mask, float a, float b) { return mask ? a : b; }

[[gnu::always_inline]] MENGER_HOST_DEVICE inline bool any(bool mask) { return mask; }

/// Returns a mask that is false in every lane.
template <class T>
MENGER_HOST_DEVICE inline MaskOf<T> nowhere() {
  if constexpr (NumberTraits<T>::width == 1) {
    return false;
  } else if constexpr (sizeof(MaskOf<T>) <= sizeof(std::uint64_t)) {
    return MaskOf<T>(typename MaskOf<T>::register_type(0));  // a constructor from bool would set it bit by bit
  } else {
    return MaskOf<T>(false);
  }
}

/// Returns a constant as a T; a pack has it in every lane.
template <class T>
MENGER_HOST_DEVICE inline T constant(double value) {
  return T(static_cast<RealOf<T>>(value));
}

/// Rounds a double to the precision of a float (24 bits) and returns it as a double. A float is returned unchanged.
///
/// Dekker's splitting: subtracting the large multiple and adding it back drops the lower 29 bits.
template <class T>
MENGER_HOST_DEVICE inline T rounded_to_single(const T& x) {
  if constexpr (sizeof(RealOf<T>) == sizeof(float)) {
    return x;
  } else {
    const T large = constant<T>(536870913.0) * x;  // 2^29 + 1
    return large - (large - x);
  }
}

/// Applies a function of one double to every lane. For rare cases that have no pack version.
template <class T, class Function>
[[gnu::noinline]] MENGER_HOST_DEVICE T apply_to_lanes(const T& x, const Function& function) {
  using Real = RealOf<T>;
  if constexpr (NumberTraits<T>::width == 1) {
    return static_cast<Real>(function(static_cast<double>(x)));
  } else {
    alignas(64) Real lanes[NumberTraits<T>::width];
    x.store_aligned(lanes);
    for (Real& lane : lanes) lane = static_cast<Real>(function(static_cast<double>(lane)));
    return T::load_aligned(lanes);
  }
}

}  // namespace menger::voxel
