#pragma once

#include <vector>

#include "fem/inflation/observables.h"
#include "fem/statics/equilibrium.h"

namespace menger::fem {

/// Adds to the displacements of points of a body of thin walls by how far the walls stand out there from their corners (see
/// wall_rise_m). The middle of a cell's face lies on a node with an even number of elements between the walls, else not: without
/// this it would seem to move less by a tenth. Collective.
void add_wall_rises(const Assembly& assembly, const std::vector<LocatedPoint>& points, const BodyState& state,
                    std::vector<PointObservation>& observations);

}  // namespace menger::fem
