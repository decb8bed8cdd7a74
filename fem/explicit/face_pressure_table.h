#pragma once

#include "fem/explicit/face_pressure_kernel.h"

namespace menger::fem::detail {

/// The function of one instruction set.
struct FacePressureTable {
  std::string_view instruction_set;
  std::size_t width;
  void (*forces)(const FaceBatches& batches, const double* positions_m, double* slots_N);
};

const FacePressureTable& baseline_face_pressure();
const FacePressureTable& avx2_face_pressure();
const FacePressureTable& avx512_face_pressure();

}  // namespace menger::fem::detail
