#pragma once

#include <vector>

#include "meshes/load_cases/load_case.h"
#include "voxel/statics/force_balance.h"

namespace menger::voxel {

/// The body of a load case with the plates that its kind asks for.
/// @throws std::invalid_argument if cell edge or wall thickness are not those of the parameters
StaticBody load_case_body(const SurrogateParameters& parameters, const meshes::LoadCase& load_case);

/// What else holds a body in load cases of a kind.
Supports load_case_supports(meshes::LoadCaseKind kind);

/// What a body of a load case bears in a state. @param state abscissae
StaticLoads load_case_loads(meshes::LoadCaseKind kind, const StaticBody& body, const std::vector<double>& state);

/// Rows of abscissae of a load case.
std::vector<std::vector<double>> load_case_states(const meshes::LoadCase& load_case);

}  // namespace menger::voxel
