#include "voxel/kernels/step_kernels.h"

namespace menger::voxel {

const StepKernels<double>& scalar_kernels_double() { return kernels_of<double>(); }
const StepKernels<float>& scalar_kernels_float() { return kernels_of<float>(); }

}  // namespace menger::voxel
