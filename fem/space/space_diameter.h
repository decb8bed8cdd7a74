#pragma once

#include "fem/space/space.h"

namespace menger::fem {

/// Returns the diagonal of the bounding box of all nodes in the reference configuration, m. Collective; the same on all ranks.
double diameter_m(const Space& space);

}  // namespace menger::fem
