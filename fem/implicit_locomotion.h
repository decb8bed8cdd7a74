#pragma once

#include <atomic>
#include <memory>

#include "fem/locomotion_dynamics.h"

namespace menger::fem {

/// The maker for studies of implicit dynamics. Elements of degree 2 have nodes beside those of the mesh, which records count and
/// displacements leave out.
///
/// Where mpirun has started several processes, the first one calls this and uses what comes, and all others call
/// help_implicit_locomotion meanwhile. States can be taken up by as many processes as they are of.
/// @throws io::InputError if the dynamics refuse the study
std::unique_ptr<LocomotionDynamics> make_implicit_locomotion(const LocomotionStudy& study, const std::atomic<bool>* stop);

/// Returns when the body of the first process is gone. @throws io::InputError as that process does
void help_implicit_locomotion(const LocomotionStudy& study, const std::atomic<bool>* stop);

}  // namespace menger::fem
