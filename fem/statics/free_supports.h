#pragma once

#include <vector>

#include "fem/statics/body.h"

namespace menger::fem {

/// Three point supports that hold the six rigid motions of a body and nothing else: in equilibrium they carry no force, so the
/// body deforms as if it floated, and the choice of the points decides only where it lies.
///
/// The points are the nodes nearest to the corners (low x, low y, low z), held in x, y, z; (high x, low y, low z), held in y and
/// z; (low x, high y, low z), held in z, of the box around all nodes: a body that is symmetric about its two vertical middle
/// planes stays level. Of several that are equally near it is the first.
/// @param nodes positions of nodes in the reference configuration, m; at least one. Where their nearest ones lie such that a
/// motion stays free (two of the three are one node), the solver says so.
std::vector<PointSupport> free_supports(const std::vector<Point>& nodes);

}  // namespace menger::fem
