#include "fem/explicit/face_pressure_evaluation.h"

namespace menger::fem::detail {

const FacePressureTable& baseline_face_pressure() { return face_pressure_table<LanePack<xsimd::batch<double>>>("baseline"); }

}  // namespace menger::fem::detail
