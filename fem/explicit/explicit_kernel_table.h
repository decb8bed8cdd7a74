#pragma once

#include "fem/elements/pack_laws.h"
#include "fem/explicit/explicit_kernel.h"

namespace menger::fem::detail {

/// Branches of elements.
struct BranchTask {
  double shear_modulus_Pa;
  double share;           ///< of the way to rest that they go before they act, in [0, 1]
  const double* tensors;  ///< nullptr: none
  double* relaxing;       ///< the same where they go a part of it
};

/// Elements and their laws; laws by index and address, so that files of one instruction set need not visit variants.
struct ExplicitTask {
  LawReference law;
  LawReference volume;
  double viscosity_Pa_s;
  BranchTask branch;
  BoxBatches batches;
  NodalMotion motion;
};

/// The functions of one instruction set.
struct ExplicitKernelTable {
  std::string_view instruction_set;
  std::size_t width;
  ElementsOutcome (*forces)(const ExplicitTask& task, double* forces_N);
  void (*energies)(const ExplicitTask& task, double* energies_J, double* smallest_ratios);
  void (*bounds)(const ExplicitTask& task, const ElementBounds& bounds);
};

const ExplicitKernelTable& baseline_explicit_kernels();
const ExplicitKernelTable& avx2_explicit_kernels();
const ExplicitKernelTable& avx512_explicit_kernels();

}  // namespace menger::fem::detail
