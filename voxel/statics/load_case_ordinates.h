#pragma once

#include <string>
#include <vector>

#include "meshes/load_cases/load_case.h"
#include "voxel/statics/equilibrium.h"

namespace menger::voxel {

/// The ordinates of a body in one state of a load case: the columns after its abscissae (see meshes::response_columns).
/// @param columns all columns, abscissae included
/// @return empty if frequencies are asked for and the equilibrium is not stable, so that it has none
/// @throws std::logic_error for a column that the surrogate does not have
std::vector<double> load_case_ordinates(const std::vector<std::string>& columns, meshes::LoadCaseKind kind,
                                        const Equilibrium& equilibrium);

}  // namespace menger::voxel
