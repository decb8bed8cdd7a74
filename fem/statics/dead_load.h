#pragma once

#include <vector>

#include "fem/space/space.h"
#include "fem/statics/body.h"

namespace menger::fem {

/// Returns the loads of fixed size and direction on a body, gravity and tractions, N per component of the local nodes. They are
/// the integrals of density g N_a over the elements and of traction N_a over the faces of this rank, in the reference
/// configuration.
std::vector<double> dead_load_of(const Space& space, const Body& body);

}  // namespace menger::fem
