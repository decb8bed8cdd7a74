#pragma once

#include <memory>

#include "fem/explicit/explicit_body.h"
#include "fem/explicit/explicit_nodes.h"
#include "fem/explicit/step_taker.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Returns a taker of steps that runs the code of blocks of threads as a block of one, on this processor: what a graphics
/// processor is compared with, and how that code is tested without one.
/// @param options those of the body; see obstacle_to_blocks
std::unique_ptr<StepTaker> lone_step_taker(const meshes::HexahedralMesh& mesh, const ExplicitBody& body,
                                           const ExplicitBodyOptions& options, const NodalLoads& loads);

}  // namespace menger::fem
