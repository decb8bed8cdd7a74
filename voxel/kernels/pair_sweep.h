#pragma once

// Included, by way of step_kernels.h, only by files that are each compiled for their own instruction set. Everything here is a
// template over the pack type, so that these files share no code.

#include "voxel/kernels/lines.h"
#include "voxel/kernels/step_data.h"
#include "voxel/laws/voxel_contact.h"

namespace menger::voxel {

/// Loads position and size (see namespace slot) of the voxels index[lane].
template <class T>
inline void load_spheres(const Spheres<RealOf<T>>& spheres, const std::int32_t* index, T (&sphere)[4]) {
  load_half_lines<T>(spheres.values, spheres.stride, index, sphere);
}

/// Finds the pairs whose spheres meet a condition, see StepKernels.
/// @param meets (square of the distance, sum of the sizes) -> mask
template <class T, class Condition>
inline std::size_t find_pairs_where(const Condition& meets, const Spheres<RealOf<T>>& spheres, const std::int32_t* first,
                                    const std::int32_t* second, std::size_t count, std::int32_t* positions) {
  constexpr std::size_t width = static_cast<std::size_t>(NumberTraits<T>::width);
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; i += width) {
    T a[4];
    T b[4];
    load_spheres<T>(spheres, first + i, a);
    load_spheres<T>(spheres, second + i, b);
    const Vector3<T> apart = {b[slot::x] - a[slot::x], b[slot::y] - a[slot::y], b[slot::z] - a[slot::z]};
    const MaskOf<T> met = meets(dot(apart, apart), a[slot::size] + b[slot::size]);
    if (!any(met)) continue;
    if constexpr (width == 1) {
      positions[found++] = static_cast<std::int32_t>(i);
    } else {
      alignas(64) RealOf<T> lanes[width];
      select(met, constant<T>(1.0), constant<T>(0.0)).store_aligned(lanes);
      for (std::size_t lane = 0; lane < width; ++lane) {
        positions[found] = static_cast<std::int32_t>(i + lane);
        found += lanes[lane] != RealOf<T>(0) ? 1U : 0U;
      }
    }
  }
  while (found > 0 && static_cast<std::size_t>(positions[found - 1]) >= count) --found;
  return found;
}

/// Finds the pairs whose spheres overlap.
template <class T>
MENGER_INLINED_WHOLE std::size_t find_touching(const Spheres<RealOf<T>>& spheres, const std::int32_t* first,
                                               const std::int32_t* second, std::size_t count, std::int32_t* positions) {
  const auto overlap = [](const T& distance2, const T& sizes) {
    return spheres_overlap(distance2, constant<T>(collision_radius_fraction) * sizes);
  };
  return find_pairs_where<T>(overlap, spheres, first, second, count, positions);
}

/// Finds the pairs whose centres are closer than a limit.
template <class T>
MENGER_INLINED_WHOLE std::size_t find_closer(const Spheres<RealOf<T>>& spheres, const std::int32_t* first,
                                             const std::int32_t* second, std::size_t count, RealOf<T> limit,
                                             std::int32_t* positions) {
  const auto closer = [limit2 = T(limit * limit)](const T& distance2, const T&) { return distance2 < limit2; };
  return find_pairs_where<T>(closer, spheres, first, second, count, positions);
}

}  // namespace menger::voxel
