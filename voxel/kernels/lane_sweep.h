#pragma once

// The sweeps over robots in lanes. Included only by files that are each compiled for their own instruction set. Everything here
// is a template over the pack type, so that these files share no code.

#include <cmath>

#include "voxel/kernels/beam_sweep.h"
#include "voxel/kernels/lane_data.h"
#include "voxel/kernels/voxel_sweep.h"
#include "voxel/laws/voxel_contact.h"

namespace menger::voxel {

/// Returns the distance, counted in numbers, between two neighbours in an array with `packs` packs each.
template <class T>
inline constexpr std::size_t pack_stride(int packs) {
  return static_cast<std::size_t>(packs) * static_cast<std::size_t>(NumberTraits<T>::width);
}

/// Loads the packs of a voxel as a line.
template <class T>
inline Lines<T> load_packs(const RealOf<T>* packs) {
  Lines<T> line;
  for (int k = 0; k < line_length; ++k) line.value[k] = load_values<T>(packs + pack_stride<T>(k));
  return line;
}

template <class T>
inline void store_packs(RealOf<T>* packs, const Lines<T>& line) {
  for (int k = 0; k < line_length; ++k) store_values<T>(packs + pack_stride<T>(k), line.value[k]);
}

/// Adds three values to the packs from `first` on; subtract_packs subtracts them.
template <class T>
inline void add_packs(RealOf<T>* packs, int first, const Vector3<T>& v) {
  const T values[3] = {v.x, v.y, v.z};
  for (int k = 0; k < 3; ++k) {
    RealOf<T>* at = packs + pack_stride<T>(first + k);
    store_values<T>(at, load_values<T>(at) + values[k]);
  }
}

template <class T>
inline void subtract_packs(RealOf<T>* packs, int first, const Vector3<T>& v) {
  const T values[3] = {v.x, v.y, v.z};
  for (int k = 0; k < 3; ++k) {
    RealOf<T>* at = packs + pack_stride<T>(first + k);
    store_values<T>(at, load_values<T>(at) - values[k]);
  }
}

template <class T>
inline VoxelCoefficients<T> lane_voxel_coefficients(const LaneData<RealOf<T>>& d, std::size_t voxel) {
  const RealOf<T>* at = d.voxel_coefficients + voxel * pack_stride<T>(voxel_values);
  return voxel_coefficients_from<T>([at](int k) { return load_values<T>(at + pack_stride<T>(k)); });
}

template <class T>
inline BeamCoefficients<T> lane_beam_coefficients(const RealOf<T>* at) {
  return beam_coefficients_from<T>([at](int k) { return load_values<T>(at + pack_stride<T>(k)); });
}

/// Returns a mask as bits, one per lane.
template <class T>
inline std::uint32_t lane_bits(const MaskOf<T>& mask) {
  if constexpr (NumberTraits<T>::width == 1) {
    return mask ? 1U : 0U;
  } else {
    if (!any(mask)) return 0;
    alignas(64) RealOf<T> lanes[NumberTraits<T>::width];
    select(mask, constant<T>(1.0), constant<T>(0.0)).store_aligned(lanes);
    std::uint32_t bits = 0;
    for (int lane = 0; lane < NumberTraits<T>::width; ++lane) {
      if (lanes[lane] != RealOf<T>(0)) bits |= 1U << lane;
    }
    return bits;
  }
}

/// Makes a beam that is not present straight and undeformed, so that its elastic loads are exactly zero and it takes no rare
/// branch.
template <class T>
inline void straighten(const MaskOf<T>& present, BeamEnds<T>& ends) {
  const T zero = constant<T>(0.0);
  const Quaternion<T> upright = {constant<T>(1.0), zero, zero, zero};
  ends.separation = select<T>(present, ends.separation, Vector3<T>{ends.rest_length, zero, zero});
  ends.lower = select<T>(present, ends.lower, upright);
  ends.upper = select<T>(present, ends.upper, upright);
}

/// Returns the inertias of the ends of a beam.
template <bool Uniform, class T>
inline EndInertias<T> lane_end_inertias(const LaneData<RealOf<T>>& d, std::size_t lower, std::size_t upper) {
  if constexpr (Uniform) {
    return {T(d.voxel.inverse_mass), T(d.voxel.inverse_mass), T(d.voxel.inverse_inertia), T(d.voxel.inverse_inertia)};
  } else {
    const VoxelCoefficients<T> at_lower = lane_voxel_coefficients<T>(d, lower);
    const VoxelCoefficients<T> at_upper = lane_voxel_coefficients<T>(d, upper);
    return {at_lower.inverse_mass, at_upper.inverse_mass, at_lower.inverse_inertia, at_upper.inverse_inertia};
  }
}

/// Returns the loads of one beam per lane in the world (permuted axes), and stores its state for the next step. Sets `in_range`
/// by its strain.
/// @param rates returns the BeamEndRates; called only for damping from velocities
/// @param remembered history_values packs, the BeamHistory
template <bool Velocity, class T, class Rates>
inline BeamLoads<T> pack_beam_loads(const StepConstants<RealOf<T>>& d, const BeamCoefficients<T>& c, BeamEnds<T> ends,
                                    const Rates& rates, RealOf<T>* remembered, MaskOf<T>& in_range) {
  if (d.single_precision_rest_lengths) ends.rest_length = rounded_to_single(ends.rest_length);
  // Not by step_of_beam: elastic and damping loads apart from each other need more registers than there are.
  const BeamHistory<T> history = load_history<T>(remembered, pack_stride<T>(1));
  const BeamState<T> state = state_of_beam(d.balances_moments, ends, history.small);
  BeamLoads<T> loads = beam_elastic_loads<false>(c, state.deformation, ends.rest_length);
  loads = loads + damping_of_beam<Velocity, false, T>(d.rate_scale, c, state, history, ends, rates);
  loads = acting_loads(d.balances_moments, loads, state, ends.rest_length);
  store_history<Velocity>(remembered, pack_stride<T>(1), state);
  in_range = is_strain_in_range(state.deformation, ends.rest_length, T(d.strain_limit));
  return to_world(state.frame, loads);
}

/// Returns the loads of one beam of every robot.
template <int Axis, bool Velocity, bool Uniform, bool Complete, class T>
inline BeamLoads<T> lane_beam_loads(const LaneData<RealOf<T>>& d, const LaneBeams<RealOf<T>>& beams, std::size_t i,
                                    BeamCoefficients<T> c, MaskOf<T>& in_range) {
  const auto lower = static_cast<std::size_t>(beams.lower[i]);
  const auto upper = static_cast<std::size_t>(beams.upper[i]);
  const std::size_t stride = pack_stride<T>(line_length);
  BeamEnds<T> ends = beam_ends<Axis>(load_packs<T>(d.pose + lower * stride), load_packs<T>(d.pose + upper * stride));
  if constexpr (!Complete) {
    const MaskOf<T> present = load_values<T>(beams.present + i * pack_stride<T>(1)) > constant<T>(0.5);
    if (d.single_precision_rest_lengths) ends.rest_length = rounded_to_single(ends.rest_length);
    straighten(present, ends);
    // The ends of a beam that is not present still move, so it must not be damped.
    c.damping_lower = select(present, c.damping_lower, constant<T>(0.0));
    c.damping_upper = select(present, c.damping_upper, constant<T>(0.0));
  }
  const auto rates = [&] {
    return beam_end_rates<Axis>(lane_end_inertias<Uniform, T>(d, lower, upper), load_packs<T>(d.motion + lower * stride),
                                load_packs<T>(d.motion + upper * stride));
  };
  return pack_beam_loads<Velocity, T>(d, c, ends, rates, beams.history + i * pack_stride<T>(history_values), in_range);
}

template <int Axis, bool Velocity, bool Uniform, bool Complete, class T>
MENGER_INLINED_WHOLE MaskOf<T> sweep_lane_axis(const LaneData<RealOf<T>>& d) {
  const LaneBeams<RealOf<T>>& beams = d.axis[Axis];
  const std::size_t stride = pack_stride<T>(line_length);
  BeamCoefficients<T> c = broadcast<T>(d.beam);
  MaskOf<T> out_of_range = nowhere<T>();
  for (std::size_t i = 0; i < beams.count; ++i) {
    if constexpr (!Uniform) c = lane_beam_coefficients<T>(beams.coefficients + i * pack_stride<T>(beam_values));
    MaskOf<T> in_range = nowhere<T>();
    const BeamLoads<T> loads = lane_beam_loads<Axis, Velocity, Uniform, Complete, T>(d, beams, i, c, in_range);
    out_of_range = out_of_range || !in_range;
    Lines<T> lower;
    Lines<T> upper;
    unpermute<Axis>(loads.lower_force, lower, slot::fx);
    unpermute<Axis>(loads.lower_moment, lower, slot::mx);
    if constexpr (!Uniform) unpermute<Axis>(loads.upper_force, upper, slot::fx);
    unpermute<Axis>(loads.upper_moment, upper, slot::mx);
    RealOf<T>* at_lower = d.load + static_cast<std::size_t>(beams.lower[i]) * stride;
    RealOf<T>* at_upper = d.load + static_cast<std::size_t>(beams.upper[i]) * stride;
    // Adding zeros of either sign changes no load: a sum that starts from +0 is never -0.
    add_packs<T>(at_lower, slot::fx, {lower.value[slot::fx], lower.value[slot::fy], lower.value[slot::fz]});
    add_packs<T>(at_lower, slot::mx, {lower.value[slot::mx], lower.value[slot::my], lower.value[slot::mz]});
    if constexpr (Uniform) {
      subtract_packs<T>(at_upper, slot::fx, {lower.value[slot::fx], lower.value[slot::fy], lower.value[slot::fz]});
    } else {
      add_packs<T>(at_upper, slot::fx, {upper.value[slot::fx], upper.value[slot::fy], upper.value[slot::fz]});
    }
    add_packs<T>(at_upper, slot::mx, {upper.value[slot::mx], upper.value[slot::my], upper.value[slot::mz]});
  }
  return out_of_range;
}

template <bool Velocity, bool Uniform, bool Complete, class T>
std::uint32_t sweep_lane_beams(const LaneData<RealOf<T>>& d) {
  const MaskOf<T> x = sweep_lane_axis<0, Velocity, Uniform, Complete, T>(d);
  const MaskOf<T> y = sweep_lane_axis<1, Velocity, Uniform, Complete, T>(d);
  const MaskOf<T> z = sweep_lane_axis<2, Velocity, Uniform, Complete, T>(d);
  return lane_bits<T>(x || y || z);
}

template <bool Uniform, bool Complete, class T>
MENGER_INLINED_WHOLE std::uint32_t sweep_lane_voxels(const LaneData<RealOf<T>>& d, RealOf<T>* largest_displacement2) {
  const T zero = constant<T>(0.0);
  const std::size_t stride = pack_stride<T>(line_length);
  const T floor_depth = load_values<T>(d.floor_depth);
  const T limit2 = load_values<T>(d.displacement_limit2);
  VoxelCoefficients<T> c = broadcast<T>(d.voxel);
  T largest2 = zero;
  MaskOf<T> out_of_range = nowhere<T>();
  for (std::size_t i = 0; i < d.voxels; ++i) {
    Lines<T> pose = load_packs<T>(d.pose + i * stride);
    Lines<T> motion = load_packs<T>(d.motion + i * stride);
    RealOf<T>* load = d.load + i * stride;
    if constexpr (!Uniform) c = lane_voxel_coefficients<T>(d, i);
    const VoxelStep<T> step = voxel_step<true, true, T>(d, floor_depth, c, pose, motion, load_packs<T>(load));
    if constexpr (std::is_same_v<RealOf<T>, float>) {
      RealOf<T>* at = d.position_residual + i * pack_stride<T>(3);
      T residual[3];
      for (int k = 0; k < 3; ++k) residual[k] = load_values<T>(at + pack_stride<T>(k));
      put_step(step, pose, motion, residual);
      for (int k = 0; k < 3; ++k) store_values<T>(at + pack_stride<T>(k), residual[k]);
    } else {
      put_step<T>(step, pose, motion, nullptr);
    }
    const RealOf<T>* drive = d.drive + i * pack_stride<T>(drive_values);
    put_size(d, load_values<T>(drive), load_values<T>(drive + pack_stride<T>(1)), load_values<T>(drive + pack_stride<T>(2)), pose,
             motion);
    store_packs<T>(d.pose + i * stride, pose);
    store_packs<T>(d.motion + i * stride, motion);
    for (const int k : {slot::fx, slot::fy, slot::fz, slot::mx, slot::my, slot::mz})
      store_values<T>(load + pack_stride<T>(k), zero);

    T displacement2 = dot(step.displacement, step.displacement);
    if constexpr (!Complete) {
      const MaskOf<T> present = load_values<T>(d.present + i * pack_stride<T>(1)) > constant<T>(0.5);
      displacement2 = select(present, displacement2, zero);
    }
    out_of_range = out_of_range || !(displacement2 <= limit2);
    largest2 = select(displacement2 > largest2, displacement2, largest2);
  }
  store_values<T>(largest_displacement2, largest2);
  return lane_bits<T>(out_of_range);
}

template <bool Uniform, class T>
inline ContactEnd<T> lane_contact_end(const LaneData<RealOf<T>>& d, std::size_t voxel) {
  VoxelCoefficients<T> c = broadcast<T>(d.voxel);
  if constexpr (!Uniform) c = lane_voxel_coefficients<T>(d, voxel);
  const Lines<T> motion = load_packs<T>(d.motion + voxel * pack_stride<T>(line_length));
  const Vector3<T> momentum = {motion.value[slot::px], motion.value[slot::py], motion.value[slot::pz]};
  return {c.inverse_mass * momentum, c.floor.stiffness, c.floor.damping};
}

template <bool Uniform, class T>
MENGER_INLINED_WHOLE void sweep_lane_pairs(const LaneData<RealOf<T>>& d) {
  const T zero = constant<T>(0.0);
  const std::size_t stride = pack_stride<T>(line_length);
  for (std::size_t i = 0; i < d.pairs.count; ++i) {
    const auto first = static_cast<std::size_t>(d.pairs.first[i]);
    const auto second = static_cast<std::size_t>(d.pairs.second[i]);
    const Lines<T> from = load_packs<T>(d.pose + first * stride);
    const Lines<T> to = load_packs<T>(d.pose + second * stride);
    const Vector3<T> apart = {to.value[slot::x] - from.value[slot::x], to.value[slot::y] - from.value[slot::y],
                              to.value[slot::z] - from.value[slot::z]};
    const T reach = constant<T>(collision_radius_fraction) * (from.value[slot::size] + to.value[slot::size]);
    const T distance2 = dot(apart, apart);
    const MaskOf<T> present = load_values<T>(d.pairs.present + i * pack_stride<T>(1)) > constant<T>(0.5);
    const MaskOf<T> touch = spheres_overlap(distance2, reach) && present;
    if (!any(touch)) continue;
    Vector3<T> force =
        contact_force(apart, distance2, reach, lane_contact_end<Uniform, T>(d, first), lane_contact_end<Uniform, T>(d, second));
    force = select<T>(touch, force, Vector3<T>{zero, zero, zero});
    add_packs<T>(d.load + first * stride, slot::fx, -force);
    add_packs<T>(d.load + second * stride, slot::fx, force);
  }
}

}  // namespace menger::voxel
