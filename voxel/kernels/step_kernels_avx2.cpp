#include "voxel/kernels/step_kernels.h"

namespace menger::voxel {

const StepKernels<double>& avx2_kernels_double() { return kernels_of<xsimd::batch<double, xsimd::avx2>>(); }
const StepKernels<float>& avx2_kernels_float() { return kernels_of<xsimd::batch<float, xsimd::avx2>>(); }

}  // namespace menger::voxel
