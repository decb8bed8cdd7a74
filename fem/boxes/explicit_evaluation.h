#pragma once

// The kernels of explicit dynamics for one type of packs. Included only by the files explicit_kernel_<instruction set>.cpp, each
// compiled for its own, and instantiated with pack types of that instruction set only.

#include "fem/boxes/box_elements.h"

namespace menger::fem::detail {

/// The count of numbers in a batch's branch tensors: six for each of eight points and each lane.
template <class Pack>
constexpr std::size_t branch_numbers = std::size_t{Pack::size} * branch_numbers_per_lane;

/// Returns the tensors of one batch, or nullptr if there are none.
template <class Pack, class Number>
Number* tensors_of(Number* tensors, std::size_t batch) {
  return tensors == nullptr ? nullptr : tensors + branch_numbers<Pack> * batch;
}

template <class Pack, class Stress>
ElementsOutcome forces_with(const ExplicitTask& task, double* forces_N) {
  const Stress stress(task);
  Pack smallest(1e300);
  Pack dissipated(0.0);
  Pack relaxed(0.0);
  for (std::size_t batch = 0; batch < task.batches.count; ++batch) {
    BoxElements<Pack> elements(task.batches, batch);
    elements.place(task.motion.displacements_m);
    const double* tensors = tensors_of<Pack>(task.branch.tensors, batch);
    if (task.branch.relaxing != nullptr) tensors = elements.relax(task.branch, tensors_of<Pack>(task.branch.relaxing, batch));
    elements.compute_forces(stress, task, tensors);
    elements.store_forces(forces_N + 24 * Pack::size * batch);
    smallest = xsimd::min(smallest, elements.smallest_ratio());
    dissipated = dissipated + elements.dissipation();
    relaxed = relaxed + elements.relaxed();
  }
  ElementsOutcome outcome;
  alignas(64) std::array<double, Pack::size> lanes;
  smallest.store_aligned(lanes.data());
  for (const double ratio : lanes)
    if (ratio < outcome.smallest_ratio) outcome.smallest_ratio = ratio;
  dissipated.store_aligned(lanes.data());
  for (const double power : lanes) outcome.dissipated_W += power;
  relaxed.store_aligned(lanes.data());
  for (const double energy : lanes) outcome.relaxed_J += energy;
  return outcome;
}

template <class Pack>
ElementsOutcome explicit_forces(const ExplicitTask& task, double* forces_N) {
  static_assert(std::is_same_v<std::variant_alternative_t<0, materials::HyperelasticLaw>, materials::NeoHookean>);
  const bool is_neo_hookean = task.law.index == 0;
  if (task.branch.tensors != nullptr) {
    if (is_neo_hookean) return forces_with<Pack, BranchedNeoHookeanStress<Pack>>(task, forces_N);
    return forces_with<Pack, BranchedGeneralStress<Pack>>(task, forces_N);
  }
  if (is_neo_hookean) return forces_with<Pack, NeoHookeanStress<Pack>>(task, forces_N);
  return forces_with<Pack, GeneralStress<Pack>>(task, forces_N);
}

template <class Pack>
void explicit_energies(const ExplicitTask& task, double* energies_J, double* smallest_ratios) {
  for (std::size_t batch = 0; batch < task.batches.count; ++batch) {
    BoxElements<Pack> elements(task.batches, batch);
    elements.place(task.motion.displacements_m);
    elements.energy(task, tensors_of<Pack>(task.branch.tensors, batch)).store_aligned(energies_J + Pack::size * batch);
    elements.smallest_ratio().store_aligned(smallest_ratios + Pack::size * batch);
  }
}

template <class Pack>
const ExplicitKernelTable& explicit_kernel_table(const char* instruction_set) {
  static const ExplicitKernelTable table{instruction_set, Pack::size, explicit_forces<Pack>, explicit_energies<Pack>};
  return table;
}

}  // namespace menger::fem::detail
