#pragma once

#include <vector>

#include "fem/space/space.h"

namespace menger::fem {

/// The part of a face's reference area that falls to each of its nodes, in m^2: integral of N_n dA, by node of the face. Their
/// sum is the area of the face. Gauss points: degree + 1 per direction.
std::vector<double> nodal_areas_m2(const Space& space, const SpaceFace& face);

}  // namespace menger::fem
