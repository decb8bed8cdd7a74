#pragma once

#include "voxel/kernels/lines.h"
#include "voxel/kernels/step_data.h"

namespace menger::voxel {

/// Returns the coefficients of a uniform body in every lane.
template <class T>
inline VoxelCoefficients<T> broadcast(const VoxelCoefficients<RealOf<T>>& c) {
  return {T(c.inverse_mass),
          T(c.inverse_inertia),
          T(c.weight),
          T(c.global_damping),
          T(c.global_rotation_damping),
          {T(c.floor.stiffness), T(c.floor.damping), T(c.floor.static_friction), T(c.floor.kinetic_friction)}};
}

template <class T>
inline BeamCoefficients<T> broadcast(const BeamCoefficients<RealOf<T>>& c) {
  return {T(c.axial),
          T(c.twist),
          T(c.shear),
          T(c.bend),
          T(c.turn),
          T(c.axial_root),
          T(c.shear_root),
          T(c.bend_root),
          T(c.turn_root),
          T(c.twist_root),
          T(c.damping_lower),
          T(c.damping_upper),
          T(c.turn_difference),
          T(c.turn_difference_root)};
}

/// Returns the coefficients of one class per lane. The two lines of class c stand at 2 c and 2 c + 1 of the table; `row` holds
/// the number of the first line.
template <class T>
inline VoxelCoefficients<T> voxel_coefficients(const RealOf<T>* table, const std::int32_t* row) {
  const Lines<T> a = load_lines<T>(table, row);
  const Lines<T> b = load_lines<T>(table + line_length, row);
  return voxel_coefficients_from<T>([&](int k) { return k < line_length ? a.value[k] : b.value[k - line_length]; });
}

template <class T>
inline BeamCoefficients<T> beam_coefficients(const RealOf<T>* table, const std::int32_t* row) {
  const Lines<T> a = load_lines<T>(table, row);
  const Lines<T> b = load_lines<T>(table + line_length, row);
  return beam_coefficients_from<T>([&](int k) { return k < line_length ? a.value[k] : b.value[k - line_length]; });
}

}  // namespace menger::voxel
