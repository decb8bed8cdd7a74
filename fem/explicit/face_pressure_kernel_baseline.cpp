#include "fem/explicit/face_pressure_evaluation.h"

namespace menger::fem::detail {

template <>
const FacePressureTable<double>& baseline_face_pressure() {
  return face_pressure_table<LanePack<xsimd::batch<double>>>("baseline");
}

template <>
const FacePressureTable<float>& baseline_face_pressure() {
  return face_pressure_table<LanePack<xsimd::batch<float>>>("baseline");
}

}  // namespace menger::fem::detail
