#pragma once

#include <cstddef>
#include <string_view>

#include "voxel/kernels/kernel_choice.h"
#include "voxel/kernels/lane_data.h"
#include "voxel/kernels/step_data.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Returns the instruction set that a request resolves to on this machine: the best available one, or the requested one.
/// @throws std::invalid_argument if this machine does not have the one requested
InstructionSet resolve(InstructionSet requested);

/// Returns the kernels of a resolved instruction set.
template <class Real>
const StepKernels<Real>& kernels_for(InstructionSet set);

/// Returns the kernels for robots in lanes with the fewest lanes that hold `robots` robots. If none has enough lanes, returns
/// those with the most lanes of the instruction set.
/// @param set resolved
template <class Real>
const LaneKernels<Real>& lane_kernels_for(InstructionSet set, std::size_t robots);

/// Returns the number of lanes of the widest kernels for robots in lanes on this machine.
/// @throws std::invalid_argument as resolve does
std::size_t most_lanes_of(NumberType number, InstructionSet requested);

/// Returns the widest kernels, for a body of `blocks` equal blocks in lanes. Null where the blocks would leave so many lanes
/// empty that stepping voxel by voxel is as fast.
/// @param set resolved
template <class Real>
const LaneKernels<Real>* kernels_for_blocks(InstructionSet set, std::size_t blocks);

std::string_view to_string(InstructionSet set);

}  // namespace menger::voxel
