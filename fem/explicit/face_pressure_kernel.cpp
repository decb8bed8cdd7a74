#include "fem/explicit/face_pressure_kernel.h"

#include "fem/elements/instruction_sets.h"
#include "fem/explicit/face_pressure_table.h"

namespace menger::fem {

using detail::FacePressureTable;

FacePressureKernels::FacePressureKernels(const FacePressureTable& table)
    : instruction_set(table.instruction_set), width(table.width), table_(&table) {}

void FacePressureKernels::forces(const FaceBatches& batches, const double* positions_m, double* slots_N) const {
  table_->forces(batches, positions_m, slots_N);
}

std::vector<FacePressureKernels> available_face_pressure_kernels() {
  std::vector<FacePressureKernels> kernels{FacePressureKernels(detail::baseline_face_pressure())};
#ifdef MENGER_X86_KERNELS
  if (detail::has_avx2()) kernels.emplace_back(detail::avx2_face_pressure());
  if (detail::has_avx512()) kernels.emplace_back(detail::avx512_face_pressure());
#endif
  return kernels;
}

FacePressureKernels best_face_pressure_kernels() { return available_face_pressure_kernels().back(); }

}  // namespace menger::fem
