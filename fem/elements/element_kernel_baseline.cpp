#include "fem/elements/element_evaluation.h"

namespace menger::fem::detail {

// The packs that every processor of this architecture has.
const KernelTable& baseline_kernels() { return kernel_table<xsimd::batch<double>>("baseline"); }

}  // namespace menger::fem::detail
