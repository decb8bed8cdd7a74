#include "fem/boxes/explicit_kernel.h"

#include <cassert>
#include <cmath>
#include <vector>

#include "fem/boxes/explicit_kernel_table.h"
#include "fem/elements/instruction_sets.h"

namespace menger::fem {

namespace {

using detail::BranchTask;
using detail::ExplicitKernelTable;
using detail::ExplicitTask;
using detail::reference_to;

/// Returns a task whose branches do not relax.
BranchTask resting(const std::vector<MaxwellBranch>& branches, const double* tensors, std::size_t sets_apart) {
  assert(branches.size() <= most_branches);
  BranchTask task{.count = branches.size(), .sets_apart = sets_apart, .tensors = branches.empty() ? nullptr : tensors};
  for (std::size_t n = 0; n < branches.size(); ++n) {
    task.shear_modulus_Pa += branches[n].shear_modulus_Pa;
    task.shear_moduli_Pa[n] = branches[n].shear_modulus_Pa;
  }
  return task;
}

BranchTask relaxing(const std::vector<MaxwellBranch>& branches, const BranchTensors& tensors) {
  BranchTask task = resting(branches, tensors.values, tensors.sets_apart);
  if (task.tensors == nullptr || !(tensors.relaxed_s > 0.0)) return task;
  for (std::size_t n = 0; n < branches.size(); ++n)
    task.shares[n] = -std::expm1(-tensors.relaxed_s / branches[n].relaxation_time_s);
  task.relaxing = tensors.values;
  return task;
}

ExplicitTask task_of(const ExplicitMaterial& material, const BranchTask& branch, const BoxBatches& batches,
                     const NodalMotion& motion) {
  return {reference_to(material.law), reference_to(material.volume), material.viscosity_Pa_s, branch, batches, motion};
}

/// Returns all kernels that this machine can run, the widest last.
const std::vector<const ExplicitKernelTable*>& available_tables() {
  static const std::vector<const ExplicitKernelTable*> tables = [] {
    std::vector<const ExplicitKernelTable*> result{&detail::baseline_explicit_kernels()};
#ifdef MENGER_X86_KERNELS
    if (detail::has_avx2()) result.push_back(&detail::avx2_explicit_kernels());
#endif
#ifdef MENGER_AVX512_KERNELS
    if (detail::has_avx512()) result.push_back(&detail::avx512_explicit_kernels());
#endif
    return result;
  }();
  return tables;
}

}  // namespace

ExplicitKernels::ExplicitKernels(const ExplicitKernelTable& table)
    : instruction_set(table.instruction_set), width(table.width), table_(&table) {}

ElementsOutcome ExplicitKernels::forces(const ExplicitMaterial& material, const BoxBatches& batches, const NodalMotion& motion,
                                        const BranchTensors& branch, double* forces_N) const {
  return table_->forces(task_of(material, relaxing(material.branches, branch), batches, motion), forces_N);
}

void ExplicitKernels::energies(const ExplicitMaterial& material, const BoxBatches& batches, const NodalMotion& motion,
                               const double* branch, std::size_t sets_apart, double* energies_J, double* smallest_ratios) const {
  table_->energies(task_of(material, resting(material.branches, branch, sets_apart), batches, motion), energies_J,
                   smallest_ratios);
}

std::vector<ExplicitKernels> available_explicit_kernels() {
  std::vector<ExplicitKernels> kernels;
  for (const ExplicitKernelTable* table : available_tables()) kernels.emplace_back(*table);
  return kernels;
}

ExplicitKernels best_explicit_kernels() { return ExplicitKernels(*available_tables().back()); }

}  // namespace menger::fem
