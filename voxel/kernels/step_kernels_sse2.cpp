#include "voxel/kernels/step_kernels.h"

namespace menger::voxel {

const StepKernels<double>& sse2_kernels_double() { return kernels_of<xsimd::batch<double, xsimd::sse2>>(); }
const StepKernels<float>& sse2_kernels_float() { return kernels_of<xsimd::batch<float, xsimd::sse2>>(); }

}  // namespace menger::voxel
