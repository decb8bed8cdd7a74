#include "fem/thin_walls/thin_wall_evaluation.h"

namespace menger::fem::detail {

// The packs that every processor of this architecture has.
template <>
const ThinWallTable<double>& baseline_thin_walls() {
  return thin_wall_table<LanePack<xsimd::batch<double>>>("baseline");
}

template <>
const ThinWallTable<float>& baseline_thin_walls() {
  return thin_wall_table<LanePack<xsimd::batch<float>>>("baseline");
}

}  // namespace menger::fem::detail
