#include "voxel/kernels/lane_kernels.h"

namespace menger::voxel {

const LaneKernels<double>& sse2_lane_kernels_double() { return lane_kernels_of<xsimd::batch<double, xsimd::sse2>>(); }
const LaneKernels<float>& sse2_lane_kernels_float() { return lane_kernels_of<xsimd::batch<float, xsimd::sse2>>(); }

}  // namespace menger::voxel
