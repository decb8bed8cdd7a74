#include "voxel/kernels/lane_kernels.h"

namespace menger::voxel {

const LaneKernels<double>& avx2_lane_kernels_double() { return lane_kernels_of<xsimd::batch<double, xsimd::avx2>>(); }
const LaneKernels<float>& avx2_lane_kernels_float() { return lane_kernels_of<xsimd::batch<float, xsimd::avx2>>(); }

}  // namespace menger::voxel
