#pragma once

#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

#include "io/text/run_status.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {

enum class Stepper;

/// What became of simulations that were advanced on a graphics processor.
struct DeviceAdvance {
  std::vector<io::RunStatus> statuses;
  std::vector<bool> on_processor;  ///< whether the device left a simulation to the processor, wholly or from some step on
};

/// Advances several simulations at once to a time, each by threads of the graphics processor. For each it does the
/// same as Simulation::advance_to, but for rounding (see DeviceGroup).
///
/// What the device cannot step is left to the processor: the energy balance, terms that are kept for comparison, and robots that
/// touch themselves at very many places (RobotEnd::crowded).
/// @throws io::DeviceError if the graphics processor fails
DeviceAdvance advance_on_device_to(std::span<Simulation> simulations, double time_s, const std::atomic<bool>* stop,
                                   Stepper stepper);

}  // namespace menger::voxel
