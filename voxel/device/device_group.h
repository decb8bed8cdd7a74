#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "voxel/device/robot_runner.h"

namespace menger::voxel {

/// Robots that are stepped together on a graphics processor, each by a block of threads or by several.
///
/// The same robot gets the same bytes every time, whatever the other robots are. They differ from those of the processor where
/// a beam bends by more than 23 degrees: sines and cosines of such angles come from other libraries.
template <class Real>
class DeviceGroup {
 public:
  /// @param robots that have not diverged; they must outlive the group
  /// @param feet of each, null where it has none
  DeviceGroup(const std::vector<MovingBody<Real>*>& robots, const std::vector<FootContact<Real>*>& feet, Stepper stepper);

  /// Takes steps unless robots diverge or `stop` becomes true, and writes the resulting states into the robots. A robot that the
  /// device cannot go on with (RobotEnd::crowded) keeps the state that it has reached.
  /// @param counts steps of each robot
  void advance(std::vector<std::uint64_t> counts, const std::atomic<bool>* stop);

 private:
  [[nodiscard]] std::vector<std::uint32_t> next_piece(const std::vector<std::uint64_t>& left) const;
  void take_origins_along();

  RobotBatch<Real> batch_;
  std::unique_ptr<RobotRunner<Real>> runner_;
};

}  // namespace menger::voxel
