#include "voxel/kernels/lane_kernels.h"

namespace menger::voxel {

const LaneKernels<double>& scalar_lane_kernels_double() { return lane_kernels_of<double>(); }
const LaneKernels<float>& scalar_lane_kernels_float() { return lane_kernels_of<float>(); }

}  // namespace menger::voxel
