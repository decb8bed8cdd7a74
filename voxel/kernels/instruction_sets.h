#pragma once

#include <cstddef>
#include <string_view>

#include "voxel/kernels/kernel_choice.h"
#include "voxel/kernels/lane_data.h"
#include "voxel/kernels/step_data.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// The instruction set that a request resolves to on this machine: the best one there is, or the requested one.
/// @throws std::invalid_argument if this machine does not have the one requested
InstructionSet resolve(InstructionSet requested);

/// The kernels of a resolved instruction set.
template <class Real>
const StepKernels<Real>& kernels_for(InstructionSet set);

/// The kernels for robots in lanes with the fewest lanes that hold so many robots, or else the most lanes that the instruction
/// set has. @param set resolved
template <class Real>
const LaneKernels<Real>& lane_kernels_for(InstructionSet set, std::size_t robots);

/// Lanes of the widest kernels for robots in lanes of a machine. @throws std::invalid_argument as resolve does
std::size_t most_lanes_of(NumberType number, InstructionSet requested);

/// The widest kernels, for so many equal blocks of a body in lanes; null where blocks leave too many lanes empty, so that
/// stepping voxel by voxel is as fast. @param set resolved
template <class Real>
const LaneKernels<Real>* kernels_for_blocks(InstructionSet set, std::size_t blocks);

std::string_view to_string(InstructionSet set);

}  // namespace menger::voxel
