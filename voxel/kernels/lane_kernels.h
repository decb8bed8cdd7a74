#pragma once

// The table of sweeps over lanes of one instruction set. Included only by the files lane_kernels_<instruction set>.cpp, each of
// which is compiled for its own instruction set.

#include "voxel/kernels/block_sweep.h"
#include "voxel/kernels/lane_sweep.h"
#include "voxel/laws/pack.h"

namespace menger::voxel {

/// Returns the table of functions that step robots, or the blocks of one robot, in SIMD lanes. Most are sweeps: loops over all
/// beams, voxels or pairs. T is a number (one lane) or a pack of numbers (one lane each).
template <class T>
const LaneKernels<RealOf<T>>& lane_kernels_of() {
  static constexpr LaneKernels<RealOf<T>> kernels = {
      NumberTraits<T>::width,
      {{{sweep_lane_beams<false, false, false, T>, sweep_lane_beams<false, false, true, T>},
        {sweep_lane_beams<false, true, false, T>, sweep_lane_beams<false, true, true, T>}},
       {{sweep_lane_beams<true, false, false, T>, sweep_lane_beams<true, false, true, T>},
        {sweep_lane_beams<true, true, false, T>, sweep_lane_beams<true, true, true, T>}}},
      {{sweep_lane_voxels<false, false, T>, sweep_lane_voxels<false, true, T>},
       {sweep_lane_voxels<true, false, T>, sweep_lane_voxels<true, true, T>}},
      {sweep_lane_pairs<false, T>, sweep_lane_pairs<true, T>},
      {{sweep_in_blocks<0, false, T>, sweep_in_blocks<1, false, T>, sweep_in_blocks<2, false, T>},
       {sweep_in_blocks<0, true, T>, sweep_in_blocks<1, true, T>, sweep_in_blocks<2, true, T>}},
      {{sweep_joints<0, false, T>, sweep_joints<1, false, T>, sweep_joints<2, false, T>},
       {sweep_joints<0, true, T>, sweep_joints<1, true, T>, sweep_joints<2, true, T>}},
      add_joint_loads<T>,
      put_spheres<T>};
  return kernels;
}

}  // namespace menger::voxel
