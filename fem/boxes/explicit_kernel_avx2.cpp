#include "fem/boxes/explicit_evaluation.h"

namespace menger::fem::detail {

const ExplicitKernelTable& avx2_explicit_kernels() {
  return explicit_kernel_table<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>("avx2");
}

}  // namespace menger::fem::detail
