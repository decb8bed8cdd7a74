#pragma once

#include <atomic>
#include <memory>

#include "fem/locomotion_dynamics.h"

namespace menger::fem {

/// The maker for studies of implicit dynamics, on one process. Elements of degree 2 have nodes beside those of the mesh, which
/// records count and displacements leave out.
/// @throws io::InputError if the dynamics refuse the study, and on more than one rank
std::unique_ptr<LocomotionDynamics> make_implicit_locomotion(const LocomotionStudy& study, const std::atomic<bool>* stop);

}  // namespace menger::fem
