#include "voxel/kernels/step_kernels.h"

namespace menger::voxel {

const StepKernels<double>& avx512_kernels_double() { return kernels_of<xsimd::batch<double, xsimd::avx512f>>(); }
const StepKernels<float>& avx512_kernels_float() { return kernels_of<xsimd::batch<float, xsimd::avx512f>>(); }

}  // namespace menger::voxel
