#include "fem/thin_walls/thin_wall_evaluation.h"

namespace menger::fem::detail {

template <>
const ThinWallTable<double>& avx512_thin_walls() {
  return thin_wall_table<LanePack<xsimd::batch<double, xsimd::avx512f>>>("avx512");
}

template <>
const ThinWallTable<float>& avx512_thin_walls() {
  return thin_wall_table<LanePack<xsimd::batch<float, xsimd::avx512f>>>("avx512");
}

}  // namespace menger::fem::detail
