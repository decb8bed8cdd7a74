#include "voxel/laws/rotation.h"

#include <cmath>

namespace menger::voxel {

double exact_rotation_vector_factor(double w) {
  const double sine2 = 1.0 - w * w;
  if (!(sine2 > 0.0)) return 0.0;
  return 2.0 * std::acos(w) / std::sqrt(sine2);
}

double exact_cosine_of_root(double x) { return std::cos(std::sqrt(x)); }

double exact_sinc_of_root(double x) {
  const double root = std::sqrt(x);
  return root > 0.0 ? std::sin(root) / root : 1.0;
}

}  // namespace menger::voxel
