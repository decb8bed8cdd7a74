#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "voxel/number.h"
#include "voxel/rotation.h"
#include "voxel/step_data.h"

namespace menger::voxel {

/// Eight lines, one per lane, seen as eight numbers or packs.
template <class T>
struct Lines {
  T value[line_length];
};

namespace detail {

template <class Register, std::size_t... I>
inline Register zip_low(Register a, Register b, std::index_sequence<I...>) {
  return __builtin_shufflevector(a, b, (I % 2 == 0 ? I / 2 : sizeof...(I) + I / 2)...);
}
template <class Register, std::size_t... I>
inline Register zip_high(Register a, Register b, std::index_sequence<I...>) {
  return __builtin_shufflevector(a, b, (I % 2 == 0 ? (sizeof...(I) + I) / 2 : sizeof...(I) + (sizeof...(I) + I) / 2)...);
}

/// One stage of the perfect shuffle of eight registers of W numbers. With the address of a number written as (register, lane) in
/// bits, a stage turns the address left by one bit; log2(W) stages turn W lines of eight numbers into eight packs, three more
/// turn them back.
template <int W, class Register>
inline void shuffle_stage(Register (&r)[line_length]) {
  constexpr auto lanes = std::make_index_sequence<static_cast<std::size_t>(W)>{};
  Register out[line_length];
  for (int i = 0; i < 4; ++i) {
    out[2 * i] = zip_low(r[i], r[i + 4], lanes);
    out[2 * i + 1] = zip_high(r[i], r[i + 4], lanes);
  }
  for (int i = 0; i < line_length; ++i) r[i] = out[i];
}

template <int W, class Register>
inline void lines_to_packs(Register (&r)[line_length]) {
  for (int lanes = 1; lanes < W; lanes *= 2) shuffle_stage<W>(r);
}

template <int W, class Register>
inline void packs_to_lines(Register (&r)[line_length]) {
  for (int bit = 0; bit < 3; ++bit) shuffle_stage<W>(r);
}

}  // namespace detail

/// The lines base[index[lane]] of all lanes.
template <class T>
inline Lines<T> load_lines(const RealOf<T>* base, const std::int32_t* index) {
  constexpr int width = NumberTraits<T>::width;
  Lines<T> out;
  if constexpr (width == 1) {
    for (int k = 0; k < line_length; ++k) out.value[k] = base[static_cast<std::ptrdiff_t>(index[0]) * line_length + k];
  } else {
    static_assert(width <= line_length, "a register longer than a line would need two lines joined");
    using Register = typename T::register_type;
    constexpr int per_line = line_length / width;
    Register r[line_length];
    for (int k = 0; k < line_length; ++k) {
      r[k] = T::load_aligned(base + static_cast<std::ptrdiff_t>(index[k / per_line]) * line_length + (k % per_line) * width);
    }
    detail::lines_to_packs<width>(r);
    for (int k = 0; k < line_length; ++k) out.value[k] = T(r[k]);
  }
  return out;
}

/// The lines that stand one after the other at `first`.
template <class T>
inline Lines<T> load_lines(const RealOf<T>* first) {
  constexpr int width = NumberTraits<T>::width;
  Lines<T> out;
  if constexpr (width == 1) {
    for (int k = 0; k < line_length; ++k) out.value[k] = first[k];
  } else {
    typename T::register_type r[line_length];
    for (int k = 0; k < line_length; ++k) r[k] = T::load_aligned(first + k * width);
    detail::lines_to_packs<width>(r);
    for (int k = 0; k < line_length; ++k) out.value[k] = T(r[k]);
  }
  return out;
}

/// Writes the lines one after the other to `first`.
template <class T>
inline void store_lines(RealOf<T>* first, const Lines<T>& lines) {
  constexpr int width = NumberTraits<T>::width;
  if constexpr (width == 1) {
    for (int k = 0; k < line_length; ++k) first[k] = lines.value[k];
  } else {
    typename T::register_type r[line_length];
    for (int k = 0; k < line_length; ++k) r[k] = lines.value[k];
    detail::packs_to_lines<width>(r);
    for (int k = 0; k < line_length; ++k) T(r[k]).store_aligned(first + k * width);
  }
}

/// Adds lane after lane the line of `lower` to base[lower_index[lane]] and that of `upper` to base[upper_index[lane]]; an index
/// may occur more than once.
template <class T>
inline void add_lines(RealOf<T>* base, const std::int32_t* lower_index, const Lines<T>& lower, const std::int32_t* upper_index,
                      const Lines<T>& upper) {
  constexpr int width = NumberTraits<T>::width;
  if constexpr (width == 1) {
    for (int k = 0; k < line_length; ++k) base[static_cast<std::ptrdiff_t>(lower_index[0]) * line_length + k] += lower.value[k];
    for (int k = 0; k < line_length; ++k) base[static_cast<std::ptrdiff_t>(upper_index[0]) * line_length + k] += upper.value[k];
  } else {
    static_assert(width <= line_length, "a register longer than a line would need two lines joined");
    using Register = typename T::register_type;
    constexpr int per_line = line_length / width;
    Register a[line_length];
    Register b[line_length];
    for (int k = 0; k < line_length; ++k) {
      a[k] = lower.value[k];
      b[k] = upper.value[k];
    }
    detail::packs_to_lines<width>(a);
    detail::packs_to_lines<width>(b);
    for (int lane = 0; lane < width; ++lane) {
      RealOf<T>* to_lower = base + static_cast<std::ptrdiff_t>(lower_index[lane]) * line_length;
      RealOf<T>* to_upper = base + static_cast<std::ptrdiff_t>(upper_index[lane]) * line_length;
      for (int part = 0; part < per_line; ++part) {
        const T sum = T::load_aligned(to_lower + part * width) + T(a[lane * per_line + part]);
        sum.store_aligned(to_lower + part * width);
      }
      for (int part = 0; part < per_line; ++part) {
        const T sum = T::load_aligned(to_upper + part * width) + T(b[lane * per_line + part]);
        sum.store_aligned(to_upper + part * width);
      }
    }
  }
}

/// Three values of a line in axes permuted so that `Axis` comes first.
template <int Axis, class T>
inline Vector3<T> permuted(const Lines<T>& line, int first) {
  return {line.value[first + Axis], line.value[first + (Axis + 1) % 3], line.value[first + (Axis + 2) % 3]};
}

/// Puts a permuted vector into a line.
template <int Axis, class T>
inline void unpermute(const Vector3<T>& v, Lines<T>& line, int first) {
  line.value[first + Axis] = v.x;
  line.value[first + (Axis + 1) % 3] = v.y;
  line.value[first + (Axis + 2) % 3] = v.z;
}

template <class T>
inline T load_values(const RealOf<T>* from) {
  if constexpr (NumberTraits<T>::width == 1) {
    return *from;
  } else {
    return T::load_aligned(from);
  }
}

template <class T>
inline void store_values(RealOf<T>* to, const T& value) {
  if constexpr (NumberTraits<T>::width == 1) {
    *to = value;
  } else {
    value.store_aligned(to);
  }
}

}  // namespace menger::voxel
