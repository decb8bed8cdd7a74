#pragma once

// Included, by way of step_kernels.h, only by files that are each compiled for their own instruction set: everything here is a
// template over the pack type, so that no code is shared between them.

#include "voxel/lines.h"
#include "voxel/step_data.h"
#include "voxel/voxel_contact.h"

namespace menger::voxel {

/// Position and size (see namespace slot) of the voxels index[lane].
template <class T>
inline void load_spheres(const Spheres<RealOf<T>>& spheres, const std::int32_t* index, T (&sphere)[4]) {
  load_half_lines<T>(spheres.values, spheres.stride, index, sphere);
  if (spheres.size == nullptr) return;
  alignas(64) RealOf<T> sizes[NumberTraits<T>::width];
  for (int lane = 0; lane < NumberTraits<T>::width; ++lane) sizes[lane] = spheres.size[index[lane]];
  sphere[slot::size] = load_values<T>(sizes);
}

/// Finds the pairs whose spheres overlap, see StepKernels.
template <class T>
MENGER_INLINED_WHOLE std::size_t find_touching(const Spheres<RealOf<T>>& spheres, const std::int32_t* first,
                                               const std::int32_t* second, std::size_t count, std::int32_t* touching) {
  constexpr std::size_t width = static_cast<std::size_t>(NumberTraits<T>::width);
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; i += width) {
    T a[4];
    T b[4];
    load_spheres<T>(spheres, first + i, a);
    load_spheres<T>(spheres, second + i, b);
    const Vector3<T> apart = {b[slot::x] - a[slot::x], b[slot::y] - a[slot::y], b[slot::z] - a[slot::z]};
    const T reach = constant<T>(collision_radius_fraction) * (a[slot::size] + b[slot::size]);
    const MaskOf<T> touch = spheres_overlap(dot(apart, apart), reach);
    if (!any(touch)) continue;
    if constexpr (width == 1) {
      touching[found++] = static_cast<std::int32_t>(i);
    } else {
      alignas(64) RealOf<T> lanes[width];
      select(touch, constant<T>(1.0), constant<T>(0.0)).store_aligned(lanes);
      for (std::size_t lane = 0; lane < width; ++lane) {
        touching[found] = static_cast<std::int32_t>(i + lane);
        found += lanes[lane] != RealOf<T>(0) ? 1U : 0U;
      }
    }
  }
  while (found > 0 && static_cast<std::size_t>(touching[found - 1]) >= count) --found;
  return found;
}

}  // namespace menger::voxel
