#include "fem/elements/element_evaluation.h"

namespace menger::fem::detail {

const KernelTable& avx2_kernels() { return kernel_table<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>("avx2"); }

}  // namespace menger::fem::detail
