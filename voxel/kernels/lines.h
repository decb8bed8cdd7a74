#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "voxel/kernels/line.h"

namespace menger::voxel {

namespace detail {

template <class Register, std::size_t... I>
inline Register zip_low(Register a, Register b, std::index_sequence<I...>) {
  return __builtin_shufflevector(a, b, (I % 2 == 0 ? I / 2 : sizeof...(I) + I / 2)...);
}
template <class Register, std::size_t... I>
inline Register zip_high(Register a, Register b, std::index_sequence<I...>) {
  return __builtin_shufflevector(a, b, (I % 2 == 0 ? (sizeof...(I) + I) / 2 : sizeof...(I) + (sizeof...(I) + I) / 2)...);
}

/// Does one stage of the perfect shuffle of eight (or four) registers of W numbers. The address of a number is (register, lane),
/// written in bits; a stage rotates this address left by one bit. log2(W) stages turn W lines of eight (four) numbers into eight
/// (four) packs. Three (two) more turn them back.
template <int W, class Register, std::size_t Count>
inline void shuffle_stage(Register (&r)[Count]) {
  constexpr auto lanes = std::make_index_sequence<static_cast<std::size_t>(W)>{};
  Register out[Count];
  for (std::size_t i = 0; i < Count / 2; ++i) {
    out[2 * i] = zip_low(r[i], r[i + Count / 2], lanes);
    out[2 * i + 1] = zip_high(r[i], r[i + Count / 2], lanes);
  }
  for (std::size_t i = 0; i < Count; ++i) r[i] = out[i];
}

template <int W, class Register, std::size_t Count>
inline void lines_to_packs(Register (&r)[Count]) {
  for (int lanes = 1; lanes < W; lanes *= 2) shuffle_stage<W>(r);
}

template <int W, class Register>
inline void packs_to_lines(Register (&r)[line_length]) {
  for (int bit = 0; bit < 3; ++bit) shuffle_stage<W>(r);
}

/// A line of single-precision numbers, half of the widest register.
using LineRegister [[gnu::vector_size(line_length * sizeof(float)), gnu::may_alias]] = float;

template <class Register, std::size_t... I>
inline Register joined(const float* low, const float* high, std::index_sequence<I...>) {
  return __builtin_shufflevector(*reinterpret_cast<const LineRegister*>(low), *reinterpret_cast<const LineRegister*>(high), I...);
}

/// Adds one half of a register, from number `First` on, to a line.
template <std::size_t First, class Register, std::size_t... I>
inline void add_half(float* line, Register r, std::index_sequence<I...>) {
  auto* sum = reinterpret_cast<LineRegister*>(line);
  *sum += __builtin_shufflevector(r, r, First + I...);
}

/// Adds the line of one lane to a line in memory.
/// @param r registers that packs_to_lines made
template <class T, class Register>
inline void add_line(RealOf<T>* line, const Register (&r)[line_length], int lane) {
  constexpr int width = NumberTraits<T>::width;
  if constexpr (width > line_length) {
    constexpr auto half = std::make_index_sequence<line_length>{};
    if (lane % 2 == 0) {
      add_half<0>(line, r[lane / 2], half);
    } else {
      add_half<line_length>(line, r[lane / 2], half);
    }
  } else {
    constexpr int per_line = line_length / width;
    for (int part = 0; part < per_line; ++part) {
      const T sum = T::load_aligned(line + part * width) + T(r[lane * per_line + part]);
      sum.store_aligned(line + part * width);
    }
  }
}

}  // namespace detail

/// Returns the lines base[index[lane]] of all lanes.
template <class T>
inline Lines<T> load_lines(const RealOf<T>* base, const std::int32_t* index) {
  constexpr int width = NumberTraits<T>::width;
  Lines<T> out;
  if constexpr (width == 1) {
    for (int k = 0; k < line_length; ++k) out.value[k] = base[static_cast<std::ptrdiff_t>(index[0]) * line_length + k];
  } else {
    using Register = typename T::register_type;
    const auto line = [&](int lane) { return base + static_cast<std::ptrdiff_t>(index[lane]) * line_length; };
    Register r[line_length];
    for (int k = 0; k < line_length; ++k) {
      if constexpr (width > line_length) {
        static_assert(width == 2 * line_length);
        r[k] =
            detail::joined<Register>(line(2 * k), line(2 * k + 1), std::make_index_sequence<static_cast<std::size_t>(width)>{});
      } else {
        constexpr int per_line = line_length / width;
        r[k] = T::load_aligned(line(k / per_line) + (k % per_line) * width);
      }
    }
    detail::lines_to_packs<width>(r);
    for (int k = 0; k < line_length; ++k) out.value[k] = T(r[k]);
  }
  return out;
}

namespace detail {

/// Loads four numbers each from base[stride * index[0]] to base[stride * index[Halves - 1]] on, one after the other. A template
/// over the pack type, so that instruction sets share no code.
template <class T, std::size_t Halves>
struct HalfLines {
  using Register [[gnu::vector_size(Halves * 4 * sizeof(RealOf<T>)), gnu::may_alias]] = RealOf<T>;

  template <std::size_t... I>
  static Register joined(typename HalfLines<T, Halves / 2>::Register low, typename HalfLines<T, Halves / 2>::Register high,
                         std::index_sequence<I...>) {
    return __builtin_shufflevector(low, high, I...);
  }

  static Register load(const RealOf<T>* base, std::ptrdiff_t stride, const std::int32_t* index) {
    return joined(HalfLines<T, Halves / 2>::load(base, stride, index),
                  HalfLines<T, Halves / 2>::load(base, stride, index + Halves / 2), std::make_index_sequence<4 * Halves>{});
  }
};

template <class T>
struct HalfLines<T, 1> {
  using Register [[gnu::vector_size(4 * sizeof(RealOf<T>)), gnu::may_alias]] = RealOf<T>;

  static Register load(const RealOf<T>* base, std::ptrdiff_t stride, const std::int32_t* index) {
    return *reinterpret_cast<const Register*>(base + *index * stride);
  }
};

}  // namespace detail

/// Loads for every lane the four numbers from base[stride * index[lane]] on.
/// @param stride a multiple of four
template <class T>
inline void load_half_lines(const RealOf<T>* base, std::ptrdiff_t stride, const std::int32_t* index, T (&values)[4]) {
  constexpr int width = NumberTraits<T>::width;
  const auto line = [&](int lane) { return base + index[lane] * stride; };
  if constexpr (width == 1) {
    for (int k = 0; k < 4; ++k) values[k] = line(0)[k];
  } else {
    using Register = typename T::register_type;
    Register r[4];
    for (int k = 0; k < 4; ++k) {
      if constexpr (width >= 4) {
        constexpr std::size_t halves = width / 4;
        r[k] = detail::HalfLines<T, halves>::load(base, stride, index + static_cast<std::size_t>(k) * halves);
      } else {
        constexpr int parts = 4 / width;
        r[k] = T::load_aligned(line(k / parts) + (k % parts) * width);
      }
    }
    detail::lines_to_packs<width>(r);
    for (int k = 0; k < 4; ++k) values[k] = T(r[k]);
  }
}

/// Returns the lines that are stored one after the other from `first` on.
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

/// Writes the lines one after the other, from `first` on.
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

/// Adds, lane after lane, the line of `lower` to base[lower_index[lane]] and the line of `upper` to base[upper_index[lane]]. An
/// index may occur more than once.
template <class T>
inline void add_lines(RealOf<T>* base, const std::int32_t* lower_index, const Lines<T>& lower, const std::int32_t* upper_index,
                      const Lines<T>& upper) {
  constexpr int width = NumberTraits<T>::width;
  if constexpr (width == 1) {
    for (int k = 0; k < line_length; ++k) base[static_cast<std::ptrdiff_t>(lower_index[0]) * line_length + k] += lower.value[k];
    for (int k = 0; k < line_length; ++k) base[static_cast<std::ptrdiff_t>(upper_index[0]) * line_length + k] += upper.value[k];
  } else {
    using Register = typename T::register_type;
    Register a[line_length];
    Register b[line_length];
    for (int k = 0; k < line_length; ++k) {
      a[k] = lower.value[k];
      b[k] = upper.value[k];
    }
    detail::packs_to_lines<width>(a);
    detail::packs_to_lines<width>(b);
    for (int lane = 0; lane < width; ++lane) {
      detail::add_line<T>(base + static_cast<std::ptrdiff_t>(lower_index[lane]) * line_length, a, lane);
      detail::add_line<T>(base + static_cast<std::ptrdiff_t>(upper_index[lane]) * line_length, b, lane);
    }
  }
}

}  // namespace menger::voxel
