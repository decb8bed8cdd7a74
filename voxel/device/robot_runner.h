#pragma once

#include <memory>

#include "voxel/device/robot_batch.h"

namespace menger::voxel {

/// Who makes the steps of a batch.
enum class Stepper {
  graphics_processor,  ///< needs one, see io::obstacle_to_device
  lone_thread          ///< the same code on the processor, without threads: slow, for tests
};

/// Makes the steps of a batch somewhere.
template <class Real>
class RobotRunner {
 public:
  RobotRunner() = default;
  RobotRunner(const RobotRunner&) = delete;
  RobotRunner& operator=(const RobotRunner&) = delete;
  virtual ~RobotRunner() = default;

  /// Makes the planned steps of all robots, and sets their outcomes.
  virtual void run() = 0;
  /// Copies the state of the robots from or to where they are stepped.
  virtual void fetch_state() = 0;
  virtual void send_state() = 0;
};

/// Returns a runner for a batch, which must outlive it and keep its arrays' sizes.
/// @throws io::DeviceError if the graphics processor does not take the batch
template <class Real>
std::unique_ptr<RobotRunner<Real>> robot_runner(RobotBatch<Real>& batch, Stepper stepper);

#ifdef MENGER_WITH_CUDA
/// The runner on a graphics processor.
template <class Real>
std::unique_ptr<RobotRunner<Real>> cuda_runner(RobotBatch<Real>& batch);
#endif

}  // namespace menger::voxel
