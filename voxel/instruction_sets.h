#pragma once

#include <string_view>

#include "voxel/kernel_choice.h"
#include "voxel/step_data.h"

namespace menger::voxel {

/// The instruction set that a request resolves to on this machine for this number type: the best one there is, or the requested
/// one.
/// @throws std::invalid_argument if this machine does not have the one requested
template <class Real>
InstructionSet resolve(InstructionSet requested);

/// The kernels of a resolved instruction set.
template <class Real>
const StepKernels<Real>& kernels_for(InstructionSet set);

std::string_view to_string(InstructionSet set);

}  // namespace menger::voxel
