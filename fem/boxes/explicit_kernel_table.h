#pragma once

#include <array>

#include "fem/boxes/explicit_kernel.h"
#include "fem/elements/pack_laws.h"

namespace menger::fem::detail {

/// The branches of elements in a task.
struct BranchTask {
  double shear_modulus_Pa = 0.0;  ///< of all of them
  std::size_t count = 0;
  std::array<double, most_branches> shear_moduli_Pa{};  ///< of each
  std::array<double, most_branches> shares{};           ///< share of the distance to rest by which each relaxes first, in [0, 1]
  std::size_t sets_apart = 0;                           ///< see BranchTensors
  const double* tensors = nullptr;                      ///< the first set; nullptr: none
  double* relaxing = nullptr;                           ///< the same tensors if they relax
};

/// Elements and their laws. Laws are given by index and address, so that the files of one instruction set need not visit
/// variants.
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
};

const ExplicitKernelTable& baseline_explicit_kernels();
const ExplicitKernelTable& avx2_explicit_kernels();
const ExplicitKernelTable& avx512_explicit_kernels();

}  // namespace menger::fem::detail
