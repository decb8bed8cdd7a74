#include "fem/elements/element_kernel.h"

#include <cassert>
#include <vector>

#include "fem/elements/element_kernel_table.h"
#include "fem/elements/instruction_sets.h"

namespace menger::fem {

namespace {

using detail::KernelTable;
using detail::reference_to;

/// All kernels this machine can run, the widest last.
const std::vector<const KernelTable*>& available_tables() {
  static const std::vector<const KernelTable*> tables = [] {
    std::vector<const KernelTable*> result{&detail::baseline_kernels()};
#ifdef MENGER_X86_KERNELS
    // This test of the compiler also checks whether the operating system saves the wide registers.
    if (detail::has_avx2()) result.push_back(&detail::avx2_kernels());
#endif
#ifdef MENGER_AVX512_KERNELS
    if (detail::has_avx512()) result.push_back(&detail::avx512_kernels());
#endif
    return result;
  }();
  return tables;
}

}  // namespace

ElementKernels::ElementKernels(const detail::KernelTable& table)
    : instruction_set(table.instruction_set), width(table.width), table_(&table) {}

void ElementKernels::evaluate(const ElementMaterial& material, const ElementBatch& batch) const {
  assert(batch.smallest_ratio != nullptr);
  table_->evaluate({material.degree, material.formulation, reference_to(material.law), reference_to(material.volume)}, batch);
}

void ElementKernels::predict_pressure(const ElementMaterial& material, const ElementBatch& batch, const double* step,
                                      double* predicted_pressure) const {
  table_->predict_pressure({material.degree, material.formulation, reference_to(material.law), reference_to(material.volume)},
                           batch, step, predicted_pressure);
}

void ElementKernels::evaluate_points(const ElementMaterial& material, const ElementBatch& batch,
                                     const PointFields& fields) const {
  table_->evaluate_points({material.degree, material.formulation, reference_to(material.law), reference_to(material.volume)},
                          batch, fields);
}

std::vector<ElementKernels> available_element_kernels() {
  std::vector<ElementKernels> kernels;
  for (const KernelTable* table : available_tables()) kernels.emplace_back(*table);
  return kernels;
}

ElementKernels best_element_kernels() { return ElementKernels(*available_tables().back()); }

}  // namespace menger::fem
