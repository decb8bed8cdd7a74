#include "fem/explicit/face_pressure_evaluation.h"

namespace menger::fem::detail {

template <>
const FacePressureTable<double>& avx512_face_pressure() {
  return face_pressure_table<LanePack<xsimd::batch<double, xsimd::avx512f>>>("avx512");
}

template <>
const FacePressureTable<float>& avx512_face_pressure() {
  return face_pressure_table<LanePack<xsimd::batch<float, xsimd::avx512f>>>("avx512");
}

}  // namespace menger::fem::detail
