#include "fem/elements/element_evaluation.h"

namespace menger::fem::detail {

const KernelTable& avx512_kernels() { return kernel_table<xsimd::batch<double, xsimd::avx512f>>("avx512"); }

}  // namespace menger::fem::detail
