#include "fem/explicit/face_pressure_evaluation.h"

namespace menger::fem::detail {

template <>
const FacePressureTable<double>& avx2_face_pressure() {
  return face_pressure_table<LanePack<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>>("avx2");
}

template <>
const FacePressureTable<float>& avx2_face_pressure() {
  return face_pressure_table<LanePack<xsimd::batch<float, xsimd::fma3<xsimd::avx2>>>>("avx2");
}

}  // namespace menger::fem::detail
