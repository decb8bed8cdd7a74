#include "fem/explicit/face_pressure_kernel.h"

#include "fem/elements/instruction_sets.h"
#include "fem/explicit/face_pressure_table.h"

namespace menger::fem {

using detail::FacePressureTable;

template <class Number>
FacePressureKernels<Number>::FacePressureKernels(const FacePressureTable<Number>& table)
    : instruction_set(table.instruction_set), width(table.width), lane_places_(table.lane_places), table_(&table) {}

template <class Number>
void FacePressureKernels<Number>::forces(const FaceBatches<Number>& batches, const Number* values_m, Number* slots_N) const {
  table_->forces(batches, values_m, slots_N);
}

template class FacePressureKernels<double>;
template class FacePressureKernels<float>;

template <class Number>
std::vector<FacePressureKernels<Number>> available_face_pressure_kernels() {
  std::vector<FacePressureKernels<Number>> kernels{FacePressureKernels<Number>(detail::baseline_face_pressure<Number>())};
#ifdef MENGER_X86_KERNELS
  if (detail::has_avx2()) kernels.emplace_back(detail::avx2_face_pressure<Number>());
#endif
#ifdef MENGER_AVX512_KERNELS
  if (detail::has_avx512()) kernels.emplace_back(detail::avx512_face_pressure<Number>());
#endif
  return kernels;
}

template std::vector<FacePressureKernels<double>> available_face_pressure_kernels();
template std::vector<FacePressureKernels<float>> available_face_pressure_kernels();

template <class Number>
FacePressureKernels<Number> best_face_pressure_kernels() {
  return available_face_pressure_kernels<Number>().back();
}

template FacePressureKernels<double> best_face_pressure_kernels();
template FacePressureKernels<float> best_face_pressure_kernels();

}  // namespace menger::fem
