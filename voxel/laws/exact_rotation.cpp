#include "voxel/laws/exact_rotation.h"

namespace menger::voxel {

double exact_rotation_vector_factor(double w) { return formula::rotation_vector_factor(w); }

double exact_cosine_of_root(double x) { return formula::cosine_of_root(x); }

double exact_sinc_of_root(double x) { return formula::sinc_of_root(x); }

}  // namespace menger::voxel
