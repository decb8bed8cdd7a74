#include "voxel/kernels/lane_kernels.h"

namespace menger::voxel {

const LaneKernels<double>& avx512_lane_kernels_double() { return lane_kernels_of<xsimd::batch<double, xsimd::avx512f>>(); }
const LaneKernels<float>& avx512_lane_kernels_float() { return lane_kernels_of<xsimd::batch<float, xsimd::avx512f>>(); }

}  // namespace menger::voxel
