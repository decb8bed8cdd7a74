#pragma once

// The sweeps of a step as templates over the number type. Included only by the files step_kernels_<instruction set>.cpp, each
// compiled for its own instruction set: everything here is a template over the pack type, so that no code is shared between them.

#include <type_traits>

#include "voxel/lines.h"
#include "voxel/step_data.h"

namespace menger::voxel {

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
  return {T(c.axial),      T(c.twist),     T(c.shear),     T(c.bend),       T(c.turn),          T(c.axial_root),
          T(c.shear_root), T(c.bend_root), T(c.turn_root), T(c.twist_root), T(c.damping_lower), T(c.damping_upper)};
}

/// Coefficients of a class per lane. The two lines of class c stand at 2 c and 2 c + 1; `row` holds the first.
template <class T>
inline VoxelCoefficients<T> voxel_coefficients(const RealOf<T>* table, const std::int32_t* row) {
  const Lines<T> a = load_lines<T>(table, row);
  const Lines<T> b = load_lines<T>(table + line_length, row);
  return {a.value[0], a.value[1], a.value[2], a.value[3], a.value[4], {a.value[5], a.value[6], a.value[7], b.value[0]}};
}

template <class T>
inline BeamCoefficients<T> beam_coefficients(const RealOf<T>* table, const std::int32_t* row) {
  const Lines<T> a = load_lines<T>(table, row);
  const Lines<T> b = load_lines<T>(table + line_length, row);
  return {a.value[0], a.value[1], a.value[2], a.value[3], a.value[4], a.value[5],
          a.value[6], a.value[7], b.value[0], b.value[1], b.value[2], b.value[3]};
}

template <class T>
inline BeamHistory<T> load_history(const RealOf<T>* history, std::size_t stride) {
  BeamHistory<T> h;
  h.deformation.displacement = {load_values<T>(history), load_values<T>(history + stride), load_values<T>(history + 2 * stride)};
  h.deformation.lower_angle_y = load_values<T>(history + 3 * stride);
  h.deformation.lower_angle_z = load_values<T>(history + 4 * stride);
  h.deformation.upper_angle = {load_values<T>(history + 5 * stride), load_values<T>(history + 6 * stride),
                               load_values<T>(history + 7 * stride)};
  h.small = load_values<T>(history + 8 * stride);
  return h;
}

template <class T>
inline void store_history(RealOf<T>* history, std::size_t stride, const BeamState<T>& state) {
  const BeamDeformation<T>& e = state.deformation;
  store_values<T>(history, e.displacement.x);
  store_values<T>(history + stride, e.displacement.y);
  store_values<T>(history + 2 * stride, e.displacement.z);
  store_values<T>(history + 3 * stride, e.lower_angle_y);
  store_values<T>(history + 4 * stride, e.lower_angle_z);
  store_values<T>(history + 5 * stride, e.upper_angle.x);
  store_values<T>(history + 6 * stride, e.upper_angle.y);
  store_values<T>(history + 7 * stride, e.upper_angle.z);
  store_values<T>(history + 8 * stride, select(state.small, constant<T>(1.0), constant<T>(0.0)));
}

/// One beam per lane, from its ends to their loads; what the sweep and the energy books share.
template <class T>
struct BeamStep {
  BeamState<T> state;
  BeamLoads<T> elastic;  ///< in the frame of the beam
  BeamLoads<T> damping;
};

template <int Axis, bool Velocity, bool Uniform, class T>
inline BeamStep<T> beam_step(const StepData<RealOf<T>>& d, const BeamAxisData<RealOf<T>>& beams, std::size_t i,
                             const BeamCoefficients<T>& c, BeamEnds<T>& ends, BeamHistory<T>& history) {
  const T half = constant<T>(0.5);
  const Lines<T> lower = load_lines<T>(d.pose, beams.lower + i);
  const Lines<T> upper = load_lines<T>(d.pose, beams.upper + i);
  ends.separation = permuted<Axis>(upper, slot::x) - permuted<Axis>(lower, slot::x);
  const Vector3<T> lower_axis = permuted<Axis>(lower, slot::qx);
  const Vector3<T> upper_axis = permuted<Axis>(upper, slot::qx);
  ends.lower = {lower.value[slot::qw], lower_axis.x, lower_axis.y, lower_axis.z};
  ends.upper = {upper.value[slot::qw], upper_axis.x, upper_axis.y, upper_axis.z};
  ends.rest_length = half * (lower.value[slot::size] + upper.value[slot::size]);
  if (d.single_precision_rest_lengths) ends.rest_length = rounded_to_single(ends.rest_length);

  history = load_history<T>(beams.history + i, beams.count);
  BeamStep<T> step;
  step.state = beam_state(ends, history.small);
  step.elastic = beam_elastic_loads(c, step.state.deformation, ends.rest_length);
  if constexpr (Velocity) {
    const Lines<T> lower_motion = load_lines<T>(d.motion, beams.lower + i);
    const Lines<T> upper_motion = load_lines<T>(d.motion, beams.upper + i);
    T lower_inverse_mass = T(d.voxel.inverse_mass), upper_inverse_mass = T(d.voxel.inverse_mass);
    T lower_inverse_inertia = T(d.voxel.inverse_inertia), upper_inverse_inertia = T(d.voxel.inverse_inertia);
    if constexpr (!Uniform) {
      std::int32_t lower_rows[NumberTraits<T>::width];
      std::int32_t upper_rows[NumberTraits<T>::width];
      for (int lane = 0; lane < NumberTraits<T>::width; ++lane) {
        lower_rows[lane] = d.voxel_class[beams.lower[i + static_cast<std::size_t>(lane)]];
        upper_rows[lane] = d.voxel_class[beams.upper[i + static_cast<std::size_t>(lane)]];
      }
      const VoxelCoefficients<T> at_lower = voxel_coefficients<T>(d.voxel_table, lower_rows);
      const VoxelCoefficients<T> at_upper = voxel_coefficients<T>(d.voxel_table, upper_rows);
      lower_inverse_mass = at_lower.inverse_mass;
      upper_inverse_mass = at_upper.inverse_mass;
      lower_inverse_inertia = at_lower.inverse_inertia;
      upper_inverse_inertia = at_upper.inverse_inertia;
    }
    BeamEndRates<T> rates;
    rates.lower_velocity = lower_inverse_mass * permuted<Axis>(lower_motion, slot::px);
    rates.upper_velocity = upper_inverse_mass * permuted<Axis>(upper_motion, slot::px);
    rates.lower_spin = lower_inverse_inertia * permuted<Axis>(lower_motion, slot::hx);
    rates.upper_spin = upper_inverse_inertia * permuted<Axis>(upper_motion, slot::hx);
    rates.rest_length_rate = half * (lower_motion.value[slot::size_rate] + upper_motion.value[slot::size_rate]);
    step.damping = beam_damping(c, rate_from_velocities(step.state, ends, rates));
  } else {
    step.damping = beam_damping(c, rate_from_increments(step.state, history.deformation, T(d.rate_scale)));
  }
  store_history<T>(beams.history + i, beams.count, step.state);
  return step;
}

template <int Axis, bool Velocity, bool Uniform, class T>
inline bool sweep_axis(const StepData<RealOf<T>>& d) {
  using std::abs;
  constexpr std::size_t width = static_cast<std::size_t>(NumberTraits<T>::width);
  const BeamAxisData<RealOf<T>>& beams = d.axis[Axis];
  BeamCoefficients<T> c = broadcast<T>(d.beam);
  const T strain_limit = T(d.strain_limit);
  bool out_of_range = false;
  for (std::size_t i = 0; i < beams.count; i += width) {
    if constexpr (!Uniform) c = beam_coefficients<T>(d.beam_table, beams.beam_class + i);
    BeamEnds<T> ends;
    BeamHistory<T> history;
    const BeamStep<T> step = beam_step<Axis, Velocity, Uniform, T>(d, beams, i, c, ends, history);
    const MaskOf<T> in_range = abs(step.state.deformation.displacement.x) <= strain_limit * ends.rest_length;
    out_of_range = out_of_range || any(!in_range);

    const BeamLoads<T> loads = to_world(step.state.frame, step.elastic + step.damping);
    Lines<T> lower;
    Lines<T> upper;
    lower.value[3] = lower.value[7] = upper.value[3] = upper.value[7] = constant<T>(0.0);
    unpermute<Axis>(loads.lower_force, lower, slot::fx);
    unpermute<Axis>(loads.lower_moment, lower, slot::mx);
    if constexpr (Uniform) {
      unpermute<Axis>(-loads.lower_force, upper, slot::fx);
    } else {
      unpermute<Axis>(loads.upper_force, upper, slot::fx);
    }
    unpermute<Axis>(loads.upper_moment, upper, slot::mx);
    add_lines<T>(d.load, beams.lower + i, lower, beams.upper + i, upper);
  }
  return out_of_range;
}

template <bool Velocity, bool Uniform, class T>
bool sweep_beams(const StepData<RealOf<T>>& d) {
  const bool x = sweep_axis<0, Velocity, Uniform, T>(d);
  const bool y = sweep_axis<1, Velocity, Uniform, T>(d);
  const bool z = sweep_axis<2, Velocity, Uniform, T>(d);
  return x || y || z;
}

/// What one step did to a voxel, per lane; what the sweep and the energy books share.
template <class T>
struct VoxelStep {
  FloorContact<T> floor;
  Vector3<T> velocity;  ///< before the step
  Vector3<T> spin;      ///< before the step
  Vector3<T> momentum;  ///< after it
  Vector3<T> spin_momentum;
  Vector3<T> displacement;
  Vector3<T> turn;  ///< rotation vector of the step
  MaskOf<T> is_static;
};

/// Moves one voxel per lane: momentum, then position; moment of momentum, then orientation (semi-implicit Euler). @cite
/// hiller2014dynamic
template <bool Floor, bool Gravity, class T>
inline VoxelStep<T> voxel_step(const StepData<RealOf<T>>& d, const VoxelCoefficients<T>& c, const Lines<T>& pose,
                               const Lines<T>& motion, const Lines<T>& load) {
  const T zero = constant<T>(0.0);
  const T time_step = T(d.time_step);
  VoxelStep<T> step;
  const Vector3<T> momentum = {motion.value[slot::px], motion.value[slot::py], motion.value[slot::pz]};
  const Vector3<T> spin_momentum = {motion.value[slot::hx], motion.value[slot::hy], motion.value[slot::hz]};
  step.velocity = c.inverse_mass * momentum;
  step.spin = c.inverse_inertia * spin_momentum;
  Vector3<T> force =
      Vector3<T>{load.value[slot::fx], load.value[slot::fy], load.value[slot::fz]} - c.global_damping * step.velocity;
  if constexpr (Gravity) force.z = force.z - c.weight;
  step.is_static = MaskOf<T>(false);
  step.floor = {MaskOf<T>(false), MaskOf<T>(false), zero, zero, zero};
  if constexpr (Floor) {
    const MaskOf<T> was_static = motion.value[slot::is_static] > constant<T>(0.5);
    step.floor =
        floor_contact(c.floor, T(d.half_edge), pose.value[slot::size], pose.value[slot::z], step.velocity, force, was_static);
    force = {force.x + step.floor.friction_x, force.y + step.floor.friction_y, force.z + step.floor.normal_force};
  }
  step.momentum = momentum + time_step * force;
  const T per_mass = time_step * c.inverse_mass;
  step.displacement = per_mass * step.momentum;
  if constexpr (Floor) {
    step.is_static = step.floor.is_static || floor_stops(step.floor, step.momentum, step.displacement, c.inverse_mass);
    step.momentum.x = select(step.is_static, zero, step.momentum.x);
    step.momentum.y = select(step.is_static, zero, step.momentum.y);
    step.displacement.x = select(step.is_static, zero, step.displacement.x);
    step.displacement.y = select(step.is_static, zero, step.displacement.y);
  }
  const Vector3<T> moment =
      Vector3<T>{load.value[slot::mx], load.value[slot::my], load.value[slot::mz]} - c.global_rotation_damping * step.spin;
  step.spin_momentum = spin_momentum + time_step * moment;
  if constexpr (Floor) {
    if (d.stop_rotation_in_static_friction) {
      step.spin_momentum = select<T>(step.is_static, Vector3<T>{zero, zero, zero}, step.spin_momentum);
    }
  }
  step.turn = (time_step * c.inverse_inertia) * step.spin_momentum;
  return step;
}

template <bool Uniform, bool Floor, bool Gravity, bool Actuated, class T>
VoxelSweep sweep_voxels(const StepData<RealOf<T>>& d) {
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
    const VoxelStep<T> step = voxel_step<Floor, Gravity, T>(d, c, pose, motion, load_lines<T>(d.load + at));

    const Quaternion<T> turned = quaternion_of(step.turn) * Quaternion<T>{pose.value[slot::qw], pose.value[slot::qx],
                                                                          pose.value[slot::qy], pose.value[slot::qz]};
    if constexpr (std::is_same_v<Real, float>) {
      // Kahan's sum: at small steps a displacement is below the last digit of a float position.
      Lines<T> residual = load_lines<T>(d.position_residual + at);
      const T moves[3] = {step.displacement.x, step.displacement.y, step.displacement.z};
      for (int k = 0; k < 3; ++k) {
        const T move = moves[k] - residual.value[k];
        const T sum = pose.value[k] + move;
        residual.value[k] = (sum - pose.value[k]) - move;
        pose.value[k] = sum;
      }
      store_lines<T>(d.position_residual + at, residual);
    } else {
      pose.value[slot::x] = pose.value[slot::x] + step.displacement.x;
      pose.value[slot::y] = pose.value[slot::y] + step.displacement.y;
      pose.value[slot::z] = pose.value[slot::z] + step.displacement.z;
    }
    pose.value[slot::qw] = turned.w;
    pose.value[slot::qx] = turned.x;
    pose.value[slot::qy] = turned.y;
    pose.value[slot::qz] = turned.z;
    if constexpr (Actuated) {
      const T sine_part = load_values<T>(d.size_sine_part + i);
      const T cosine_part = load_values<T>(d.size_cosine_part + i);
      const T sine = T(d.next_sine);
      const T cosine = T(d.next_cosine);
      pose.value[slot::size] = load_values<T>(d.size_base + i) + (sine_part * sine + cosine_part * cosine);
      motion.value[slot::size_rate] = T(d.angular_frequency) * (sine_part * cosine - cosine_part * sine);
    }
    motion.value[slot::px] = step.momentum.x;
    motion.value[slot::py] = step.momentum.y;
    motion.value[slot::pz] = step.momentum.z;
    motion.value[slot::hx] = step.spin_momentum.x;
    motion.value[slot::hy] = step.spin_momentum.y;
    motion.value[slot::hz] = step.spin_momentum.z;
    motion.value[slot::is_static] = select(step.is_static, constant<T>(1.0), zero);
    store_lines<T>(d.pose + at, pose);
    store_lines<T>(d.motion + at, motion);
    store_lines<T>(d.load + at, d.external_load == nullptr ? no_load : load_lines<T>(d.external_load + at));

    // Padding voxels move like the others but count for nothing.
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

/// All sweeps for one number or pack type.
template <class T>
const StepKernels<RealOf<T>>& kernels_of() {
  static constexpr StepKernels<RealOf<T>> kernels = {
      {{sweep_beams<false, false, T>, sweep_beams<false, true, T>}, {sweep_beams<true, false, T>, sweep_beams<true, true, T>}},
      {{{{sweep_voxels<false, false, false, false, T>, sweep_voxels<false, false, false, true, T>},
         {sweep_voxels<false, false, true, false, T>, sweep_voxels<false, false, true, true, T>}},
        {{sweep_voxels<false, true, false, false, T>, sweep_voxels<false, true, false, true, T>},
         {sweep_voxels<false, true, true, false, T>, sweep_voxels<false, true, true, true, T>}}},
       {{{sweep_voxels<true, false, false, false, T>, sweep_voxels<true, false, false, true, T>},
         {sweep_voxels<true, false, true, false, T>, sweep_voxels<true, false, true, true, T>}},
        {{sweep_voxels<true, true, false, false, T>, sweep_voxels<true, true, false, true, T>},
         {sweep_voxels<true, true, true, false, T>, sweep_voxels<true, true, true, true, T>}}}}};
  return kernels;
}

}  // namespace menger::voxel
