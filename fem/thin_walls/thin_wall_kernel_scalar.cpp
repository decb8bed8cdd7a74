#include "fem/thin_walls/thin_wall_evaluation.h"

namespace menger::fem::detail {

// One element at a time, without packs: what the others are compared with.
template <>
const ThinWallTable<double>& scalar_thin_walls() {
  return thin_wall_table<double>("scalar");
}

template <>
const ThinWallTable<float>& scalar_thin_walls() {
  return thin_wall_table<float>("scalar");
}

}  // namespace menger::fem::detail
