#include "voxel/instruction_sets.h"

#include <stdexcept>
#include <string>
#include <type_traits>

namespace menger::voxel {

namespace {

bool machine_has(InstructionSet set) {
#ifdef MENGER_X86_KERNELS
  // The compiler's test and not xsimd's, which does not ask whether the operating system saves the wide registers.
  switch (set) {
    case InstructionSet::scalar:
      return true;
    case InstructionSet::sse2:
      return __builtin_cpu_supports("sse2") != 0;
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
    case InstructionSet::best:
      break;
  }
  return false;
#else
  return set == InstructionSet::scalar;
#endif
}

}  // namespace

template <class Real>
InstructionSet resolve(InstructionSet requested) {
  // There is no float kernel of 16 lanes: a register would hold two lines.
  constexpr bool has_avx512 = std::is_same_v<Real, double>;
  if (requested == InstructionSet::best) {
    if (has_avx512 && machine_has(InstructionSet::avx512)) return InstructionSet::avx512;
    if (machine_has(InstructionSet::avx2)) return InstructionSet::avx2;
    return machine_has(InstructionSet::sse2) ? InstructionSet::sse2 : InstructionSet::scalar;
  }
  if (requested == InstructionSet::avx512 && !has_avx512) throw std::invalid_argument("there are no avx512 kernels for float32");
  if (!machine_has(requested))
    throw std::invalid_argument("this machine has no " + std::string(to_string(requested)) + " kernels");
  return requested;
}

template <>
const StepKernels<double>& kernels_for<double>(InstructionSet set) {
#ifdef MENGER_X86_KERNELS
  if (set == InstructionSet::avx512) return avx512_kernels_double();
  if (set == InstructionSet::avx2) return avx2_kernels_double();
  if (set == InstructionSet::sse2) return sse2_kernels_double();
#endif
  (void)set;
  return scalar_kernels_double();
}

template <>
const StepKernels<float>& kernels_for<float>(InstructionSet set) {
#ifdef MENGER_X86_KERNELS
  if (set == InstructionSet::avx2) return avx2_kernels_float();
  if (set == InstructionSet::sse2) return sse2_kernels_float();
#endif
  (void)set;
  return scalar_kernels_float();
}

std::string_view to_string(InstructionSet set) {
  switch (set) {
    case InstructionSet::best:
      return "best";
    case InstructionSet::scalar:
      return "scalar";
    case InstructionSet::sse2:
      return "sse2";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
  }
  return "best";
}

template InstructionSet resolve<double>(InstructionSet);
template InstructionSet resolve<float>(InstructionSet);

}  // namespace menger::voxel
