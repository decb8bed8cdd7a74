#pragma once

#include <vector>

#include "fem/statics/body.h"

namespace menger::fem {

/// Returns three point supports that hold the six rigid motions of a body and nothing else. In equilibrium they carry no force.
/// The body therefore deforms as if it floated, and the choice of the points only decides where it lies.
///
/// The points are the nodes nearest to three corners of the bounding box of all nodes: (low x, low y, low z), held in x, y, z;
/// (high x, low y, low z), held in y and z; (low x, high y, low z), held in z. A body that is symmetric about its two vertical
/// middle planes therefore stays level. Of several nodes that are equally near, the first is taken.
/// @param nodes positions of nodes in the reference configuration, m; at least one. If a motion stays free because two of the
/// three points are the same node, the solver reports it.
std::vector<PointSupport> free_supports(const std::vector<Point>& nodes);

}  // namespace menger::fem
