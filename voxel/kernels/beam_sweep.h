#pragma once

// Included, by way of step_kernels.h and lane_kernels.h, by files that are each compiled for their own instruction set.
// Everything here is a template over the pack type, so that these files share no code. The energy balance (EnergyBalance)
// includes it for scalars.

#include "voxel/kernels/class_coefficients.h"
#include "voxel/kernels/lines.h"
#include "voxel/kernels/step_data.h"
#include "voxel/laws/beam.h"

namespace menger::voxel {

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

/// Stores the state of a beam for the next step. Damping from velocities needs only the extension and whether the state is small.
template <bool Velocity, class T>
inline void store_history(RealOf<T>* history, std::size_t stride, const BeamState<T>& state) {
  const BeamDeformation<T>& e = state.deformation;
  store_values<T>(history, e.displacement.x);
  if constexpr (!Velocity) {
    store_values<T>(history + stride, e.displacement.y);
    store_values<T>(history + 2 * stride, e.displacement.z);
    store_values<T>(history + 3 * stride, e.lower_angle_y);
    store_values<T>(history + 4 * stride, e.lower_angle_z);
    store_values<T>(history + 5 * stride, e.upper_angle.x);
    store_values<T>(history + 6 * stride, e.upper_angle.y);
    store_values<T>(history + 7 * stride, e.upper_angle.z);
  }
  store_values<T>(history + 8 * stride, select(state.small, constant<T>(1.0), constant<T>(0.0)));
}

/// Returns the ends of a beam from their poses. The rest length is the mean of their sizes.
template <int Axis, class T>
inline BeamEnds<T> beam_ends(const Lines<T>& lower, const Lines<T>& upper) {
  BeamEnds<T> ends;
  ends.separation = permuted<Axis>(upper, slot::x) - permuted<Axis>(lower, slot::x);
  const Vector3<T> lower_axis = permuted<Axis>(lower, slot::qx);
  const Vector3<T> upper_axis = permuted<Axis>(upper, slot::qx);
  ends.lower = {lower.value[slot::qw], lower_axis.x, lower_axis.y, lower_axis.z};
  ends.upper = {upper.value[slot::qw], upper_axis.x, upper_axis.y, upper_axis.z};
  ends.rest_length = constant<T>(0.5) * (lower.value[slot::size] + upper.value[slot::size]);
  return ends;
}

/// Inverse mass (1/kg) and inverse moment of inertia (1/(kg m^2)) of the ends of a beam.
template <class T>
struct EndInertias {
  T lower_mass, upper_mass, lower_moment, upper_moment;
};

/// Returns how fast the two ends of a beam move and turn, and how fast its rest length changes.
///
/// Velocities and angular velocities are the momenta of the two voxels times their inverse inertias, in axes permuted so that the
/// beam's own comes first. The rate of the rest length is the mean of the rates of the sizes of the two voxels.
/// @param lower, upper the lines of motion of the two voxels, see StepData::motion
template <int Axis, class T>
inline BeamEndRates<T> beam_end_rates(const EndInertias<T>& inverse, const Lines<T>& lower, const Lines<T>& upper) {
  return {inverse.lower_mass * permuted<Axis>(lower, slot::px), inverse.upper_mass * permuted<Axis>(upper, slot::px),
          inverse.lower_moment * permuted<Axis>(lower, slot::hx), inverse.upper_moment * permuted<Axis>(upper, slot::hx),
          constant<T>(0.5) * (lower.value[slot::size_rate] + upper.value[slot::size_rate])};
}

/// State and loads of one beam per lane in a step. The sweep and the energy balance share it.
template <class T>
struct BeamStep {
  BeamState<T> state;
  BeamLoads<T> elastic;  ///< in the frame of the beam
  BeamLoads<T> damping;
};

/// Returns the inertias of the ends of the beams from `i` on, one beam per lane.
template <BeamVariety Variety, class T>
inline EndInertias<T> end_inertias(const StepData<RealOf<T>>& d, const BeamAxisData<RealOf<T>>& beams, std::size_t i) {
  if constexpr (Variety == BeamVariety::uniform) {
    return {T(d.voxel.inverse_mass), T(d.voxel.inverse_mass), T(d.voxel.inverse_inertia), T(d.voxel.inverse_inertia)};
  } else {
    std::int32_t lower_rows[NumberTraits<T>::width];
    std::int32_t upper_rows[NumberTraits<T>::width];
    for (int lane = 0; lane < NumberTraits<T>::width; ++lane) {
      lower_rows[lane] = d.voxel_class[beams.lower[i + static_cast<std::size_t>(lane)]];
      upper_rows[lane] = d.voxel_class[beams.upper[i + static_cast<std::size_t>(lane)]];
    }
    const VoxelCoefficients<T> lower = voxel_coefficients<T>(d.voxel_table, lower_rows);
    const VoxelCoefficients<T> upper = voxel_coefficients<T>(d.voxel_table, upper_rows);
    return {lower.inverse_mass, upper.inverse_mass, lower.inverse_inertia, upper.inverse_inertia};
  }
}

template <int Axis, bool Velocity, BeamVariety Variety, class T>
inline BeamStep<T> beam_step(const StepData<RealOf<T>>& d, const BeamAxisData<RealOf<T>>& beams, std::size_t i,
                             const BeamCoefficients<T>& c, BeamEnds<T>& ends, BeamHistory<T>& history) {
  ends = beam_ends<Axis>(load_lines<T>(d.pose, beams.lower + i), load_lines<T>(d.pose, beams.upper + i));
  if constexpr (has_own_lengths(Variety)) ends.rest_length = load_values<T>(beams.rest_length + i);
  if (d.single_precision_rest_lengths) ends.rest_length = rounded_to_single(ends.rest_length);
  if constexpr (Variety == BeamVariety::own_kinks)
    kink(ends, load_values<T>(beams.half_kink + i), load_values<T>(beams.half_kink + beams.count + i));

  history = load_history<T>(beams.history + i, beams.count);
  BeamStep<T> step;
  step.state = beam_state(ends, history.small);
  constexpr bool shears = has_own_lengths(Variety);
  step.elastic = beam_elastic_loads<shears>(c, step.state.deformation, ends.rest_length);
  if constexpr (Velocity) {
    BeamEndRates<T> rates = beam_end_rates<Axis>(end_inertias<Variety, T>(d, beams, i), load_lines<T>(d.motion, beams.lower + i),
                                                 load_lines<T>(d.motion, beams.upper + i));
    if constexpr (has_own_lengths(Variety)) rates.rest_length_rate = load_values<T>(beams.rest_length_rate + i);
    if constexpr (Variety == BeamVariety::own_kinks) {
      add_kink_rate(rates, ends, load_values<T>(beams.half_kink + 2 * beams.count + i),
                    load_values<T>(beams.half_kink + 3 * beams.count + i));
    }
    step.damping = beam_damping<shears>(c, rate_from_velocities(step.state, ends, rates));
  } else {
    step.damping = beam_damping<shears>(c, rate_from_increments(step.state, history.deformation, T(d.rate_scale)));
  }
  store_history<Velocity>(beams.history + i, beams.count, step.state);
  return step;
}

template <int Axis, bool Velocity, BeamVariety Variety, class T>
MENGER_INLINED_WHOLE bool sweep_axis(const StepData<RealOf<T>>& d) {
  using std::abs;
  constexpr bool uniform = Variety == BeamVariety::uniform;
  constexpr std::size_t width = static_cast<std::size_t>(NumberTraits<T>::width);
  const BeamAxisData<RealOf<T>>& beams = d.axis[Axis];
  BeamCoefficients<T> c = broadcast<T>(d.beam);
  const T strain_limit = T(d.strain_limit);
  bool out_of_range = false;
  for (std::size_t i = 0; i < beams.count; i += width) {
    if constexpr (!uniform) c = beam_coefficients<T>(d.beam_table, beams.beam_class + i);
    BeamEnds<T> ends;
    BeamHistory<T> history;
    const BeamStep<T> step = beam_step<Axis, Velocity, Variety, T>(d, beams, i, c, ends, history);
    const MaskOf<T> in_range = abs(step.state.deformation.displacement.x) <= strain_limit * ends.rest_length;
    out_of_range = out_of_range || any(!in_range);

    const BeamLoads<T> loads = to_world(step.state.frame, step.elastic + step.damping);
    Lines<T> lower;
    Lines<T> upper;
    lower.value[3] = lower.value[7] = upper.value[3] = upper.value[7] = constant<T>(0.0);
    unpermute<Axis>(loads.lower_force, lower, slot::fx);
    unpermute<Axis>(loads.lower_moment, lower, slot::mx);
    if constexpr (uniform) {
      unpermute<Axis>(-loads.lower_force, upper, slot::fx);
    } else {
      unpermute<Axis>(loads.upper_force, upper, slot::fx);
    }
    unpermute<Axis>(loads.upper_moment, upper, slot::mx);
    add_lines<T>(d.load, beams.lower + i, lower, beams.upper + i, upper);
  }
  return out_of_range;
}

template <bool Velocity, BeamVariety Variety, class T>
bool sweep_beams(const StepData<RealOf<T>>& d) {
  const bool x = sweep_axis<0, Velocity, Variety, T>(d);
  const bool y = sweep_axis<1, Velocity, Variety, T>(d);
  const bool z = sweep_axis<2, Velocity, Variety, T>(d);
  return x || y || z;
}

}  // namespace menger::voxel
