#pragma once

#include "fem/explicit_kernel.h"
#include "fem/pack_laws.h"

namespace menger::fem::detail {

/// Elements and their laws; laws by index and address, so that files of one instruction set need not visit variants.
struct ExplicitTask {
  LawReference law;
  LawReference volume;
  double viscosity_Pa_s;
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
