#pragma once

// Included, by way of step_kernels.h and lane_kernels.h, by files that are each compiled for their own instruction set.
// Everything here is a template over the pack type, so that these files share no code. The energy balance (EnergyBalance)
// includes it for scalars.

#include "voxel/kernels/beam_step.h"
#include "voxel/kernels/class_coefficients.h"
#include "voxel/kernels/lines.h"
#include "voxel/kernels/step_data.h"

namespace menger::voxel {

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
                             const BeamCoefficients<T>& c, BeamEnds<T>& ends) {
  ends = beam_ends<Axis>(load_lines<T>(d.pose, beams.lower + i), load_lines<T>(d.pose, beams.upper + i));
  if constexpr (has_own_lengths(Variety)) ends.rest_length = load_values<T>(beams.rest_length + i);
  if (d.single_precision_rest_lengths) ends.rest_length = rounded_to_single(ends.rest_length);
  if constexpr (Variety == BeamVariety::own_kinks)
    kink(ends, load_values<T>(beams.half_kink + i), load_values<T>(beams.half_kink + beams.count + i));

  const auto rates = [&] {
    BeamEndRates<T> rate = beam_end_rates<Axis>(end_inertias<Variety, T>(d, beams, i), load_lines<T>(d.motion, beams.lower + i),
                                                load_lines<T>(d.motion, beams.upper + i));
    if constexpr (has_own_lengths(Variety)) rate.rest_length_rate = load_values<T>(beams.rest_length_rate + i);
    if constexpr (Variety == BeamVariety::own_kinks) {
      add_kink_rate(rate, ends, load_values<T>(beams.half_kink + 2 * beams.count + i),
                    load_values<T>(beams.half_kink + 3 * beams.count + i));
    }
    return rate;
  };
  return step_of_beam<Velocity, has_own_lengths(Variety), T>(d.rate_scale, d.balances_moments, c, ends, rates, beams.history + i,
                                                             beams.count);
}

template <int Axis, bool Velocity, BeamVariety Variety, class T>
MENGER_INLINED_WHOLE bool sweep_axis(const StepData<RealOf<T>>& d) {
  constexpr bool uniform = Variety == BeamVariety::uniform;
  constexpr std::size_t width = static_cast<std::size_t>(NumberTraits<T>::width);
  const BeamAxisData<RealOf<T>>& beams = d.axis[Axis];
  BeamCoefficients<T> c = broadcast<T>(d.beam);
  const T strain_limit = T(d.strain_limit);
  bool out_of_range = false;
  for (std::size_t i = 0; i < beams.count; i += width) {
    if constexpr (!uniform) c = beam_coefficients<T>(d.beam_table, beams.beam_class + i);
    BeamEnds<T> ends;
    const BeamStep<T> step = beam_step<Axis, Velocity, Variety, T>(d, beams, i, c, ends);
    const MaskOf<T> in_range = is_strain_in_range(step.state.deformation, ends.rest_length, strain_limit);
    out_of_range = out_of_range || any(!in_range);

    const BeamLoads<T> loads = to_world(step.state.frame, loads_of(d, step, ends.rest_length));
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
