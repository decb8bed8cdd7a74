#include "voxel/device/robot_runner.h"

#include <stdexcept>

#include "io/device/graphics_processor.h"

namespace menger::voxel {

namespace {

template <class Real>
class LoneRunner final : public RobotRunner<Real> {
 public:
  explicit LoneRunner(RobotBatch<Real>& batch) : batch_(batch) {}
  void run() override { batch_.step_alone(); }
  void fetch_state() override {}
  void send_state() override {}

 private:
  RobotBatch<Real>& batch_;
};

}  // namespace

template <class Real>
std::unique_ptr<RobotRunner<Real>> robot_runner(RobotBatch<Real>& batch, Stepper stepper) {
  if (stepper == Stepper::lone_thread) return std::make_unique<LoneRunner<Real>>(batch);
#ifdef MENGER_WITH_CUDA
  return cuda_runner(batch);
#else
  throw std::runtime_error(io::obstacle_to_device());
#endif
}

template std::unique_ptr<RobotRunner<double>> robot_runner(RobotBatch<double>&, Stepper);
template std::unique_ptr<RobotRunner<float>> robot_runner(RobotBatch<float>&, Stepper);

}  // namespace menger::voxel
