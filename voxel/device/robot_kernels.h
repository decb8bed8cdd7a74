#pragma once

#include <cuda_runtime_api.h>

#include <cstddef>
#include <cstdint>

#include "voxel/device/robot_data.h"

namespace menger::voxel {

/// Starts a kernel that makes the steps of some robots, each by as many blocks as the shape says.
/// @param robots positions in the batch, in the memory of the device
/// @throws io::DeviceError if CUDA refuses it
template <class Real>
void launch_steps(const LaunchShape& shape, const BatchArrays<Real>& arrays, const std::uint32_t* robots, std::size_t count,
                  cudaStream_t stream);

}  // namespace menger::voxel
