#pragma once

// Included, by way of step_kernels.h and lane_kernels.h, by files that are each compiled for their own instruction set.
// Everything here is a template over the pack type, so that these files share no code. The energy balance (EnergyBalance)
// includes it for scalars.

#include <type_traits>

#include "voxel/kernels/class_coefficients.h"
#include "voxel/kernels/lines.h"
#include "voxel/kernels/step_data.h"
#include "voxel/kernels/voxel_step.h"

namespace menger::voxel {

template <bool Uniform, bool Floor, bool Gravity, bool Actuated, class T>
MENGER_INLINED_WHOLE VoxelSweep sweep_voxels(const StepData<RealOf<T>>& d) {
  using Real = RealOf<T>;
  constexpr std::size_t width = static_cast<std::size_t>(NumberTraits<T>::width);
  const T zero = constant<T>(0.0);
  VoxelCoefficients<T> c = broadcast<T>(d.voxel);
  VoxelSweep seen;
  T largest2 = zero;
  Lines<T> no_load;
  for (T& value : no_load.value) value = zero;
  for (std::size_t i = 0; i < d.padded_voxels; i += width) {
    const std::size_t at = i * line_length;
    Lines<T> pose = load_lines<T>(d.pose + at);
    Lines<T> motion = load_lines<T>(d.motion + at);
    if constexpr (!Uniform) c = voxel_coefficients<T>(d.voxel_table, d.voxel_class + i);
    const VoxelStep<T> step = voxel_step<Floor, Gravity, T>(d, T(d.floor_depth), c, pose, motion, load_lines<T>(d.load + at));

    if constexpr (std::is_same_v<Real, float>) {
      Lines<T> residual = load_lines<T>(d.position_residual + at);
      put_step(step, pose, motion, residual.value);
      store_lines<T>(d.position_residual + at, residual);
    } else {
      put_step<T>(step, pose, motion, nullptr);
    }
    if constexpr (Actuated) {
      put_size(d, load_values<T>(d.size_base + i), load_values<T>(d.size_sine_part + i), load_values<T>(d.size_cosine_part + i),
               pose, motion);
    }
    store_lines<T>(d.pose + at, pose);
    store_lines<T>(d.motion + at, motion);
    store_lines<T>(d.load + at, d.external_load == nullptr ? no_load : load_lines<T>(d.external_load + at));

    // Padding voxels move like the others but are not counted.
    T displacement2 = dot(step.displacement, step.displacement);
    if (i + width > d.voxels) {
      if constexpr (width == 1) {
        displacement2 = zero;
      } else {
        alignas(64) Real lanes[width];
        displacement2.store_aligned(lanes);
        for (std::size_t lane = 0; lane < width; ++lane) {
          if (i + lane >= d.voxels) lanes[lane] = Real(0);
        }
        displacement2 = T::load_aligned(lanes);
      }
    }
    const MaskOf<T> in_range = displacement2 <= T(d.displacement_limit2);
    seen.out_of_range = seen.out_of_range || any(!in_range);
    largest2 = select(displacement2 > largest2, displacement2, largest2);
  }
  if constexpr (width == 1) {
    seen.largest_displacement2 = static_cast<double>(largest2);
  } else {
    alignas(64) Real lanes[width];
    largest2.store_aligned(lanes);
    for (const Real lane : lanes) {
      if (static_cast<double>(lane) > seen.largest_displacement2) seen.largest_displacement2 = static_cast<double>(lane);
    }
  }
  return seen;
}

}  // namespace menger::voxel
