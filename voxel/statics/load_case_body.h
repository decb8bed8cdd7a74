#pragma once

#include <vector>

#include "meshes/load_cases/load_case.h"
#include "voxel/statics/force_balance.h"

namespace menger::voxel {

/// The body of a load case, with the plates of its kind.
/// @throws std::invalid_argument if cell edge or wall thickness are not those of the parameters
StaticBody load_case_body(const SurrogateParameters& parameters, const meshes::LoadCase& load_case);

/// The supports of a body in load cases of a kind, other than plates.
Supports load_case_supports(meshes::LoadCaseKind kind);

/// The loads on the body of a load case in one state. @param state abscissae
StaticLoads load_case_loads(meshes::LoadCaseKind kind, const StaticBody& body, const std::vector<double>& state);

/// The states of a load case: rows of abscissae.
std::vector<std::vector<double>> load_case_states(const meshes::LoadCase& load_case);

}  // namespace menger::voxel
