#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "evolution/trade_off/trade_off_elements.h"
#include "evolution/trade_off/trade_off_table.h"
#include "evolution/trade_off/trade_off_voxels.h"

namespace menger::evolution {

/// How far the finest run may be off, relative, by observable: the sum of
/// - the mesh: from three meshes of the same degree, each twice as fine as the one before, by Richardson's extrapolation with the
///   order that they show, between one and four; from two by their difference; without another mesh of this degree by the
///   difference to the next coarser of any;
/// - compressibility: the error is taken as inverse to the bulk modulus, from the next smaller ratio;
/// - the tolerance: the difference to the next larger one.
/// Parts for which there is no second run count nothing; none where there is no second run at all.
/// @param fidelities of element_fidelities @param rows of the same runs @param reference among them, completed
std::vector<std::optional<double>> element_reference_errors(const std::vector<ElementFidelity>& fidelities,
                                                            const std::vector<TradeRow>& rows, std::size_t reference);

/// How far the finest voxel run may be off, relative, by its one value: the error is taken as proportional to the time step, from
/// the run with the next larger step and all else equal; none without such a run. Motion that depends on the step erratically
/// may be further off.
/// @param fidelities of the rows
std::optional<double> gait_reference_error(const std::vector<VoxelFidelity>& fidelities, const std::vector<TradeRow>& rows,
                                           std::size_t reference);

}  // namespace menger::evolution
