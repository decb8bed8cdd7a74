#pragma once

#include "voxel/kernels/step_data.h"
#include "voxel/laws/number.h"
#include "voxel/laws/rotation.h"

namespace menger::voxel {

/// One line per lane. value[k] holds the k-th value of every line, as a number or as a pack.
template <class T>
struct Lines {
  T value[line_length];
};

/// Returns three values of a line, from `first` on, in axes permuted so that `Axis` comes first.
template <int Axis, class T>
MENGER_HOST_DEVICE inline Vector3<T> permuted(const Lines<T>& line, int first) {
  return {line.value[first + Axis], line.value[first + (Axis + 1) % 3], line.value[first + (Axis + 2) % 3]};
}

/// Writes a permuted vector into a line, from `first` on.
template <int Axis, class T>
MENGER_HOST_DEVICE inline void unpermute(const Vector3<T>& v, Lines<T>& line, int first) {
  line.value[first + Axis] = v.x;
  line.value[first + (Axis + 1) % 3] = v.y;
  line.value[first + (Axis + 2) % 3] = v.z;
}

template <class T>
MENGER_HOST_DEVICE inline T load_values(const RealOf<T>* from) {
  if constexpr (NumberTraits<T>::width == 1) {
    return *from;
  } else {
    return T::load_aligned(from);
  }
}

template <class T>
MENGER_HOST_DEVICE inline void store_values(RealOf<T>* to, const T& value) {
  if constexpr (NumberTraits<T>::width == 1) {
    *to = value;
  } else {
    value.store_aligned(to);
  }
}

}  // namespace menger::voxel
