#pragma once

#include <memory>

#include "fem/explicit/explicit_body.h"
#include "fem/explicit/explicit_nodes.h"
#include "fem/explicit/step_taker.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Returns a taker of steps on the graphics processor, a block of threads for the body. Each has a queue of its own: so many
/// bodies move at once as there are threads of this processor that wait for them, up to 128.
/// @param options those of the body; see obstacle_to_blocks
/// @throws std::runtime_error where menger was built without CUDA and where there is no graphics processor, io::InputError for a
/// body that blocks of threads do not take
std::unique_ptr<StepTaker> cuda_step_taker(const meshes::HexahedralMesh& mesh, const ExplicitBody& body,
                                           const ExplicitBodyOptions& options, const NodalLoads& loads);

}  // namespace menger::fem
