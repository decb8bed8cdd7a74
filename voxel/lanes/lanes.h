#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "io/text/run_status.h"
#include "voxel/kernels/kernel_choice.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {

/// When several simulations run together in the lanes of SIMD registers. This changes their speed, never their results.
enum class LaneUse {
  where_faster,  ///< where lanes_pay estimates a gain
  always         ///< for comparison
};

/// Advances several simulations at once to a time, each in its own SIMD lane. For each it does the same as
/// Simulation::advance_to.
///
/// Every simulation gives the same bytes as alone, for any content of the other lanes. Simulations go together if they have equal
/// physics, cell edge, grid, time step and steps so far; those of similar shape are put together first. A lane also computes the
/// voxels that only other lanes have. Robots of one shape are therefore fastest, and robots that differ too much run alone. These
/// also run alone: calibrated bodies, bodies with lateral coupling or external loads, drives that are not a sine from the start
/// on, and simulations with the energy balance.
/// @param instruction_set the widest to use; by default the best of the machine
/// @return completed, diverged or stopped, per simulation
/// @throws std::invalid_argument for more than 1e18 steps, and for an instruction set that this machine does not have
[[nodiscard]] std::vector<io::RunStatus> advance_together_to(std::span<Simulation> simulations, double time_s,
                                                             const std::atomic<bool>* stop = nullptr,
                                                             InstructionSet instruction_set = InstructionSet::best,
                                                             LaneUse use = LaneUse::where_faster);

}  // namespace menger::voxel
