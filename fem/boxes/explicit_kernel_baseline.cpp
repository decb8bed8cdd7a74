#include "fem/boxes/explicit_evaluation.h"

namespace menger::fem::detail {

// Uses the packs that every processor of this architecture has.
const ExplicitKernelTable& baseline_explicit_kernels() { return explicit_kernel_table<xsimd::batch<double>>("baseline"); }

}  // namespace menger::fem::detail
