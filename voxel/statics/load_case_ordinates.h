#pragma once

#include <string>
#include <vector>

#include "meshes/load_cases/load_case.h"
#include "voxel/statics/equilibrium.h"

namespace menger::voxel {

/// What is observed of a body in a state of a load case, by the columns beyond its abscissae (see meshes::response_columns).
/// @param columns all of them
/// @return nothing where frequencies are asked for and the equilibrium is not stable, so that it has none
/// @throws std::logic_error for a column that the surrogate does not know
std::vector<double> load_case_ordinates(const std::vector<std::string>& columns, meshes::LoadCaseKind kind,
                                        const Equilibrium& equilibrium);

}  // namespace menger::voxel
