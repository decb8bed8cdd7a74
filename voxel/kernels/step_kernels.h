#pragma once

// The table of sweeps of one instruction set. Included only by the files step_kernels_<instruction set>.cpp, each of which is
// compiled for its own instruction set.

#include "voxel/kernels/beam_sweep.h"
#include "voxel/kernels/pair_sweep.h"
#include "voxel/kernels/voxel_sweep.h"
#include "voxel/laws/pack.h"

namespace menger::voxel {

/// Returns all sweeps for one number or pack type.
template <class T>
const StepKernels<RealOf<T>>& kernels_of() {
  static constexpr StepKernels<RealOf<T>> kernels = {
      {{sweep_beams<false, BeamVariety::classes, T>, sweep_beams<false, BeamVariety::uniform, T>,
        sweep_beams<false, BeamVariety::own_lengths, T>, sweep_beams<false, BeamVariety::own_kinks, T>},
       {sweep_beams<true, BeamVariety::classes, T>, sweep_beams<true, BeamVariety::uniform, T>,
        sweep_beams<true, BeamVariety::own_lengths, T>, sweep_beams<true, BeamVariety::own_kinks, T>}},
      {{{{sweep_voxels<false, false, false, false, T>, sweep_voxels<false, false, false, true, T>},
         {sweep_voxels<false, false, true, false, T>, sweep_voxels<false, false, true, true, T>}},
        {{sweep_voxels<false, true, false, false, T>, sweep_voxels<false, true, false, true, T>},
         {sweep_voxels<false, true, true, false, T>, sweep_voxels<false, true, true, true, T>}}},
       {{{sweep_voxels<true, false, false, false, T>, sweep_voxels<true, false, false, true, T>},
         {sweep_voxels<true, false, true, false, T>, sweep_voxels<true, false, true, true, T>}},
        {{sweep_voxels<true, true, false, false, T>, sweep_voxels<true, true, false, true, T>},
         {sweep_voxels<true, true, true, false, T>, sweep_voxels<true, true, true, true, T>}}}},
      find_touching<T>,
      find_closer<T>};
  return kernels;
}

}  // namespace menger::voxel
