#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "meshes/load_cases/load_case.h"
#include "voxel/model/surrogate_parameters.h"
#include "voxel/statics/responder.h"

namespace menger::voxel {

/// Computes the response of a surrogate body to a load case at the given states (pressure, imposed). Responses are equilibria of
/// the same beams that Simulation steps, found by Newton's method (see equilibrium.h), and small vibrations about them.
///
/// Plates are joined to the voxels at the end of the body by half beams of length L / 2, with the class of those voxels.
/// @param states rows of abscissae, as many as meshes::abscissa_count(kind) each; empty: those of the load case
/// @throws std::invalid_argument if cell edge or wall thickness are not those of the parameters
LoadCaseResponse respond(const SurrogateParameters& parameters, const meshes::LoadCase& load_case,
                         const std::vector<std::vector<double>>& states = {});

class Equilibrium;

/// Called for every state reached, with its row.
using StateVisitor = std::function<void(std::size_t row, const Equilibrium& equilibrium)>;

/// Does the same as respond, and passes every equilibrium to a visitor.
LoadCaseResponse visit_states(const SurrogateParameters& parameters, const meshes::LoadCase& load_case,
                              const std::vector<std::vector<double>>& states, const StateVisitor& visit);

}  // namespace menger::voxel
