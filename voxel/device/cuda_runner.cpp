#include <deque>
#include <span>

#include "io/device/device_memory.h"
#include "voxel/device/robot_kernels.h"
#include "voxel/device/robot_runner.h"

namespace menger::voxel {

namespace {

/// Robots of different shapes of launch are stepped at the same time, each shape in a queue of its own.
template <class Real>
class CudaRunner final : public RobotRunner<Real> {
 public:
  explicit CudaRunner(RobotBatch<Real>& batch)
      : batch_(batch),
        data_(batch.data.size()),
        steps_(batch.data.size()),
        outcomes_(batch.data.size()),
        state_(batch.state.size()),
        constants_(std::span<const Real>(batch.constants)),
        indices_(std::span<const std::int32_t>(batch.indices)),
        partners_(batch.partners_size),
        loads_(batch.loads_size),
        phases_(std::span<const double>(batch.phases)),
        walls_(std::span<const WallLaws>(batch.walls)),
        necks_and_elbows_(std::span<const NeckOrElbow>(batch.necks_and_elbows)),
        feet_(std::span<const DeviceFoot>(batch.feet)),
        grounds_(std::span<const VoxelCoefficients<double>>(batch.grounds)),
        responses_(batch.responses_size),
        ranges_(batch.ranges_size),
        grips_(batch.grips.size()),
        touches_(batch.touches.size()) {
    for (const Launch& launch : batch.launches()) {
      queues_.emplace_back();
      robots_.emplace_back(std::span<const std::uint32_t>(launch.robots));
    }
    send_state();
  }

  void run() override {
    if (drives_.size() < batch_.drives.size()) drives_ = io::DeviceArray<DriveMoment>(batch_.drives.size());
    data_.put(batch_.data, copies_);
    steps_.put(batch_.steps, copies_);
    drives_.put(batch_.drives, copies_);
    copies_.wait();
    const BatchArrays<Real> arrays{.robots = data_.get(),
                                   .steps = steps_.get(),
                                   .outcomes = outcomes_.get(),
                                   .state = state_.get(),
                                   .constants = constants_.get(),
                                   .indices = indices_.get(),
                                   .drives = drives_.get(),
                                   .partners = partners_.get(),
                                   .loads = loads_.get(),
                                   .phases = phases_.get(),
                                   .walls = walls_.get(),
                                   .necks_and_elbows = necks_and_elbows_.get(),
                                   .feet = feet_.get(),
                                   .grounds = grounds_.get(),
                                   .responses = responses_.get(),
                                   .ranges = ranges_.get(),
                                   .grips = grips_.get(),
                                   .touches = touches_.get()};
    for (std::size_t i = 0; i < queues_.size(); ++i)
      launch_steps(batch_.launches()[i].shape, arrays, robots_[i].get(), robots_[i].size(), queues_[i].get());
    for (const io::DeviceStream& queue : queues_) queue.wait();
    outcomes_.take(batch_.outcomes, copies_);
    copies_.wait();
  }

  void fetch_state() override {
    state_.take(batch_.state, copies_);
    grips_.take(batch_.grips, copies_);
    touches_.take(batch_.touches, copies_);
    copies_.wait();
  }

  void send_state() override {
    state_.put(batch_.state, copies_);
    grips_.put(batch_.grips, copies_);
    touches_.put(batch_.touches, copies_);
    copies_.wait();
  }

 private:
  RobotBatch<Real>& batch_;
  io::DeviceStream copies_;
  io::DeviceArray<RobotData<Real>> data_;
  io::DeviceArray<std::uint32_t> steps_;
  io::DeviceArray<RobotOutcome> outcomes_;
  io::DeviceArray<Real> state_;
  io::DeviceArray<Real> constants_;
  io::DeviceArray<std::int32_t> indices_;
  io::DeviceArray<DriveMoment> drives_;
  io::DeviceArray<std::int32_t> partners_;
  io::DeviceArray<Real> loads_;
  io::DeviceArray<double> phases_;
  io::DeviceArray<WallLaws> walls_;
  io::DeviceArray<NeckOrElbow> necks_and_elbows_;
  io::DeviceArray<DeviceFoot> feet_;
  io::DeviceArray<VoxelCoefficients<double>> grounds_;
  io::DeviceArray<WallResponse> responses_;
  io::DeviceArray<double> ranges_;
  io::DeviceArray<FootGrip> grips_;
  io::DeviceArray<std::uint32_t> touches_;
  std::deque<io::DeviceStream> queues_;                ///< one per launch
  std::deque<io::DeviceArray<std::uint32_t>> robots_;  ///< of each launch
};

}  // namespace

template <class Real>
std::unique_ptr<RobotRunner<Real>> cuda_runner(RobotBatch<Real>& batch) {
  return std::make_unique<CudaRunner<Real>>(batch);
}

template std::unique_ptr<RobotRunner<double>> cuda_runner(RobotBatch<double>&);
template std::unique_ptr<RobotRunner<float>> cuda_runner(RobotBatch<float>&);

}  // namespace menger::voxel
