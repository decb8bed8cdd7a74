#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "voxel/device/robot_data.h"
#include "voxel/engine/foot_contact.h"
#include "voxel/engine/moving_body.h"

namespace menger::voxel {

/// Robots of one shape of launch.
struct Launch {
  LaunchShape shape;
  std::vector<std::uint32_t> robots;  ///< positions in the batch
};

/// The numbers of several robots, put together for the memory of a graphics processor, and back.
///
/// It also takes the steps itself, with a lone thread in place of a block of threads: that is slow, and for tests.
template <class Real>
class RobotBatch {
 public:
  /// @param robots that run_on_device; they must outlive the batch
  /// @param contacts the feet of each, null where it has none
  RobotBatch(std::vector<MovingBody<Real>*> robots, std::vector<FootContact<Real>*> contacts);

  [[nodiscard]] const std::vector<MovingBody<Real>*>& robots() const { return robots_; }

  /// Sets the number of steps that each robot makes next, and the drive in these steps. A robot that has come to an end makes
  /// none.
  /// @param most per robot
  void plan(const std::vector<std::uint32_t>& most);

  /// Makes the planned steps with lone threads.
  void step_alone();

  /// Counts the steps in `outcomes`, which were made as planned.
  void note_outcomes();

  /// Returns the number of steps that a robot has made since it was put into the batch or last taken.
  [[nodiscard]] std::uint64_t made(std::size_t robot) const { return progress_[robot].made; }
  /// Whether a robot makes more steps in the batch.
  [[nodiscard]] bool goes_on(std::size_t robot) const { return progress_[robot].end == RobotEnd::completed; }

  /// Writes the state of a robot into its body, which takes its steps over.
  void take(std::size_t robot);
  /// Reads the state of a robot from its body.
  void put(std::size_t robot);

  /// Returns the launches that step all robots.
  [[nodiscard]] const std::vector<Launch>& launches() const { return launches_; }

  // What lies in the memory of the processor that steps them, see BatchArrays.
  std::vector<RobotData<Real>> data;
  std::vector<std::uint32_t> steps;
  std::vector<RobotOutcome> outcomes;
  std::vector<Real> state, constants;
  std::vector<std::int32_t> indices;
  std::vector<DriveMoment> drives;
  std::vector<double> phases;
  std::vector<WallLaws> walls;
  std::vector<NeckOrElbow> necks_and_elbows;
  std::vector<DeviceFoot> feet;
  std::vector<VoxelCoefficients<double>> grounds;
  std::vector<FootGrip> grips;
  std::vector<std::uint32_t> touches;
  std::size_t responses_size = 0;
  std::size_t ranges_size = 0;
  std::size_t partners_size = 0;  ///< scratch memory, in numbers
  std::size_t loads_size = 0;

 private:
  void add(const MovingBody<Real>& robot, const FootContact<Real>* contact);
  void add_beams(const MovingBody<Real>& robot, RobotData<Real>& one);
  void add_beams_of_voxels(RobotData<Real>& one);
  void add_voxels(const MovingBody<Real>& robot, RobotData<Real>& one);
  void add_contacts(const MovingBody<Real>& robot, RobotData<Real>& one);
  void add_coupling(const MovingBody<Real>& robot, RobotData<Real>& one);
  void add_calibrated(const MovingBody<Real>& robot, const FootContact<Real>* contact, RobotData<Real>& one);
  void add_feet(const MovingBody<Real>& robot, const FootContact<Real>& contact, RobotData<Real>& one);
  void put_feet(std::size_t robot);
  void take_feet(std::size_t robot);
  void choose_launch(std::uint32_t position);
  [[nodiscard]] std::uint64_t all_steps(std::size_t robot) const {
    return robots_[robot]->record().steps + progress_[robot].made;
  }

  /// What a robot has done in the batch.
  struct Progress {
    std::uint64_t made = 0;
    RobotEnd end = RobotEnd::completed;
    StrainRange strains;
  };

  std::vector<MovingBody<Real>*> robots_;
  std::vector<FootContact<Real>*> contacts_;  ///< per robot, or null
  bool all_fit_blocks_ = true;                ///< each robot fits the memory of a block
  std::vector<Progress> progress_;
  std::vector<Launch> launches_;
};

}  // namespace menger::voxel
