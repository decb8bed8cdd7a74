#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "meshes/load_cases/load_case.h"
#include "voxel/model/surrogate_parameters.h"
#include "voxel/statics/responder.h"

namespace menger::voxel {

/// What the surrogate of a body answers to a load case, at the states (pressure, imposed) that are asked for: equilibria of the
/// same beams that Simulation steps, found by Newton's method (see equilibrium.h), and small vibrations about them.
///
/// Plates are joined to the voxels at the end of the body by half beams of length L / 2 of those voxels' own class.
/// @param states rows of abscissae, as many as meshes::abscissa_count(kind) each; empty: those of the load case
/// @throws std::invalid_argument if cell edge or wall thickness are not those of the parameters
LoadCaseResponse respond(const SurrogateParameters& parameters, const meshes::LoadCase& load_case,
                         const std::vector<std::vector<double>>& states = {});

class Equilibrium;

/// Called with every state reached and its row.
using StateVisitor = std::function<void(std::size_t row, const Equilibrium& equilibrium)>;

/// The same, and shows its equilibria on the way.
LoadCaseResponse visit_states(const SurrogateParameters& parameters, const meshes::LoadCase& load_case,
                              const std::vector<std::vector<double>>& states, const StateVisitor& visit);

}  // namespace menger::voxel
