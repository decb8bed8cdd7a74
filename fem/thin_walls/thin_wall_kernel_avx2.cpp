#include "fem/thin_walls/thin_wall_evaluation.h"

namespace menger::fem::detail {

template <>
const ThinWallTable<double>& avx2_thin_walls() {
  return thin_wall_table<LanePack<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>>("avx2");
}

template <>
const ThinWallTable<float>& avx2_thin_walls() {
  return thin_wall_table<LanePack<xsimd::batch<float, xsimd::fma3<xsimd::avx2>>>>("avx2");
}

}  // namespace menger::fem::detail
