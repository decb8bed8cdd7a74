#pragma once

#include <vector>

#include "fem/space/space.h"

namespace menger::fem {

/// Returns the share of each node in the reference area of a face, m^2: the integral of N_n dA, by node of the face. The shares
/// add up to the area of the face. Gauss's rule has degree + 1 points per direction.
std::vector<double> nodal_areas_m2(const Space& space, const SpaceFace& face);

}  // namespace menger::fem
