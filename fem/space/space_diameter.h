#pragma once

#include "fem/space/space.h"

namespace menger::fem {

/// Diagonal of the box along the axes around all nodes in the reference configuration, m. Collective; the same on all ranks.
double diameter_m(const Space& space);

}  // namespace menger::fem
