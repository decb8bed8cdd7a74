#include "fem/explicit/face_pressure_evaluation.h"

namespace menger::fem::detail {

const FacePressureTable& avx2_face_pressure() {
  return face_pressure_table<LanePack<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>>("avx2");
}

}  // namespace menger::fem::detail
