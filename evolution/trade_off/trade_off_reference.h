#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "evolution/trade_off/trade_off_elements.h"
#include "evolution/trade_off/trade_off_table.h"
#include "evolution/trade_off/trade_off_voxels.h"

namespace menger::evolution {

/// Estimates the relative error of the reference, the finest run, for each observable. It is the sum of three parts:
/// - Mesh: from three meshes of the same degree, each twice as fine as the previous one, by Richardson's extrapolation with the
///   observed order, limited to between one and four. From two meshes of this degree, their difference. Without another mesh of
///   this degree, the difference from the next coarser mesh of any degree.
/// - Compressibility: from the run with the next smaller bulk ratio, if the error is inversely proportional to the bulk modulus.
/// - Tolerance: the difference from the run with the next larger tolerance.
///
/// A part without a second run counts as zero. Without any second run there is no estimate.
/// @param fidelities from element_fidelities
/// @param rows of the same runs
/// @param reference position of the reference among them; it has completed
std::vector<std::optional<double>> element_reference_errors(const std::vector<ElementFidelity>& fidelities,
                                                            const std::vector<TradeRow>& rows, std::size_t reference);

/// Estimates the relative error of the one value of the reference, the finest voxel run. The estimate assumes an error
/// proportional to the time step, and uses the run with the next larger time step and otherwise the same fidelity. None without
/// such a run. If the motion depends on the time step irregularly, the true error may be larger.
/// @param fidelities those of the rows
std::optional<double> gait_reference_error(const std::vector<VoxelFidelity>& fidelities, const std::vector<TradeRow>& rows,
                                           std::size_t reference);

}  // namespace menger::evolution
