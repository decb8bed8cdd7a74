#pragma once

// A step of a beam, wherever its numbers lie. Everything here is a template over the number type: sweeps take it for packs, the
// energy balance and graphics processors for plain numbers.

#include <cmath>
#include <cstddef>

#include "voxel/kernels/line.h"
#include "voxel/kernels/step_data.h"
#include "voxel/laws/beam.h"

namespace menger::voxel {

template <class T>
MENGER_HOST_DEVICE inline BeamHistory<T> load_history(const RealOf<T>* history, std::size_t stride) {
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
MENGER_HOST_DEVICE inline void store_history(RealOf<T>* history, std::size_t stride, const BeamState<T>& state) {
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
MENGER_HOST_DEVICE inline BeamEnds<T> beam_ends(const Lines<T>& lower, const Lines<T>& upper) {
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
MENGER_HOST_DEVICE inline BeamEndRates<T> beam_end_rates(const EndInertias<T>& inverse, const Lines<T>& lower,
                                                         const Lines<T>& upper) {
  return {inverse.lower_mass * permuted<Axis>(lower, slot::px), inverse.upper_mass * permuted<Axis>(upper, slot::px),
          inverse.lower_moment * permuted<Axis>(lower, slot::hx), inverse.upper_moment * permuted<Axis>(upper, slot::hx),
          constant<T>(0.5) * (lower.value[slot::size_rate] + upper.value[slot::size_rate])};
}

/// State and loads of one beam per lane in a step. The sweep and the energy balance share it.
template <class T>
struct BeamStep {
  BeamState<T> state;
  BeamLoads<T> elastic;  ///< in the frame of the beam, as the laws give them; see loads_of
  BeamLoads<T> damping;
};

/// Returns the state of a beam in this step.
/// @param balances see StepConstants::balances_moments
/// @param small whether the beam was in the small-angle state, see published_state
template <class T>
MENGER_HOST_DEVICE inline BeamState<T> state_of_beam(bool balances, const BeamEnds<T>& ends, const T& small) {
  return balances ? balanced_state(ends) : published_state(ends, small);
}

/// Returns loads on a beam, in its frame, as they act on its ends.
/// @param balances see StepConstants::balances_moments
/// @param loads as the laws give them
template <class T>
MENGER_HOST_DEVICE inline BeamLoads<T> acting_loads(bool balances, const BeamLoads<T>& loads, const BeamState<T>& state,
                                                    const T& rest_length) {
  return balances ? balanced(loads, state, rest_length) : loads;
}

/// Returns all loads on a beam in a step, in its frame.
template <class T>
MENGER_HOST_DEVICE inline BeamLoads<T> loads_of(const StepConstants<RealOf<T>>& d, const BeamStep<T>& step,
                                                const T& rest_length) {
  return acting_loads(d.balances_moments, step.elastic + step.damping, step.state, rest_length);
}

/// Returns the damping loads of one beam per lane in this step, in its frame.
/// @tparam Velocity damping is from velocities, see DampingMode
/// @tparam Shears as for beam_elastic_loads
/// @param rate_scale see StepConstants
/// @param last state of the beam after the last step
/// @param rates returns the BeamEndRates; called only for damping from velocities
template <bool Velocity, bool Shears, class T, class Rates>
MENGER_HOST_DEVICE inline BeamLoads<T> damping_of_beam(const RealOf<T>& rate_scale, const BeamCoefficients<T>& c,
                                                       const BeamState<T>& state, const BeamHistory<T>& last,
                                                       const BeamEnds<T>& ends, const Rates& rates) {
  if constexpr (Velocity) {
    return beam_damping<Shears>(c, rate_from_velocities(state, ends, rates()));
  } else {
    return beam_damping<Shears>(c, rate_from_increments(state, last.deformation, T(rate_scale)));
  }
}

/// Returns the state of one beam per lane in this step with its loads, and stores the state for the next step. Parameters are
/// those of damping_of_beam.
/// @param balances see StepConstants::balances_moments
/// @param history of the beam, history_values numbers or packs, `stride` numbers from one to the next
template <bool Velocity, bool Shears, class T, class Rates>
MENGER_HOST_DEVICE inline BeamStep<T> step_of_beam(const RealOf<T>& rate_scale, bool balances, const BeamCoefficients<T>& c,
                                                   const BeamEnds<T>& ends, const Rates& rates, RealOf<T>* history,
                                                   std::size_t stride) {
  const BeamHistory<T> last = load_history<T>(history, stride);
  BeamStep<T> step;
  step.state = state_of_beam(balances, ends, last.small);
  step.elastic = beam_elastic_loads<Shears>(c, step.state.deformation, ends.rest_length);
  step.damping = damping_of_beam<Velocity, Shears, T>(rate_scale, c, step.state, last, ends, rates);
  store_history<Velocity>(history, stride, step.state);
  return step;
}

/// Whether the axial strain of a beam is within the limit, and a number.
template <class T>
MENGER_HOST_DEVICE inline MaskOf<T> is_strain_in_range(const BeamDeformation<T>& e, const T& rest_length, const T& strain_limit) {
  using std::abs;
  return abs(e.displacement.x) <= strain_limit * rest_length;
}

}  // namespace menger::voxel
