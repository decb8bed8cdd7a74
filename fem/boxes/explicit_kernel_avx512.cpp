#include "fem/boxes/explicit_evaluation.h"

namespace menger::fem::detail {

const ExplicitKernelTable& avx512_explicit_kernels() {
  return explicit_kernel_table<xsimd::batch<double, xsimd::avx512f>>("avx512");
}

}  // namespace menger::fem::detail
