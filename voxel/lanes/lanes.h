#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "io/text/run_status.h"
#include "voxel/kernels/kernel_choice.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {

/// Chooses when several simulations run together in the lanes of SIMD registers. It changes their speed, never their results.
enum class LaneUse {
  where_faster,  ///< see lanes_pay
  always         ///< for comparison
};

/// Advances several simulations at once, each in a SIMD lane of its own: what Simulation::advance_to does for one.
///
/// Every simulation gives the same bytes as alone, whatever the other lanes hold. Simulations of equal physics, cell
/// edge, grid, time step and steps so far go together, those of similar shape first; a lane also computes the voxels that only
/// others have, so that robots of one shape are fastest, and those that differ too much go alone. Alone go also calibrated
/// bodies, lateral coupling, external loads, drives that are not a sine from the start on, and the energy ledger.
/// @param instruction_set the widest to be used; a machine's own by default
/// @return per simulation completed, diverged or stopped
/// @throws std::invalid_argument for more than 1e18 steps, and for an instruction set that this machine does not have
[[nodiscard]] std::vector<io::RunStatus> advance_together_to(std::span<Simulation> simulations, double time_s,
                                                             const std::atomic<bool>* stop = nullptr,
                                                             InstructionSet instruction_set = InstructionSet::best,
                                                             LaneUse use = LaneUse::where_faster);

}  // namespace menger::voxel
