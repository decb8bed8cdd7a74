#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "voxel/engine/moving_body.h"
#include "voxel/kernels/lane_data.h"
#include "voxel/lanes/lane_state.h"

namespace menger::voxel {

/// Robots that are stepped together, one per SIMD lane, up to the number of lanes of a register. Each robot gets the same bytes
/// as alone.
///
/// A robot that diverges is taken out at the end of its step. Its lane continues as a copy of another robot, so that no number
/// that is not finite stays in a register.
template <class Real>
class LaneGroup {
 public:
  /// @param robots 1 to kernels.lanes bodies that run in lanes and have not diverged, with equal physics, time step and steps so
  /// far; they must outlive the group
  LaneGroup(const std::vector<MovingBody<Real>*>& robots, const LaneKernels<Real>& kernels);

  /// Takes `count` steps unless all robots diverge or `stop` becomes true, and writes the resulting states into the robots.
  void advance(std::uint64_t count, const std::atomic<bool>* stop);

 private:
  struct Robot {
    MovingBody<Real>* moving;
    LanePlaces places;
    bool in_lane = true;
  };

  /// The lane of one robot, as MovingBody::end_step needs it.
  struct Lane {
    LaneGroup& group;
    std::size_t number;

    void take() const;
    void take_poses() const;
    void put_positions() const;
  };

  static Lattice shared_lattice(const std::vector<MovingBody<Real>*>& robots);
  void choose_kernels(const LaneKernels<Real>& kernels);
  void step();
  void add_contacts();
  void renew_pairs();
  void fill_lanes();

  Lattice lattice_;
  LaneState<Real> state_;
  std::vector<Robot> robots_;  ///< those given to the constructor, one per lane
  std::vector<int> pairs_of_;  ///< per lane: the robot whose close pairs the lane uses
  typename LaneKernels<Real>::BeamSweep beams_ = nullptr;
  typename LaneKernels<Real>::VoxelSweepFunction voxels_ = nullptr;
  typename LaneKernels<Real>::PairSweep pairs_ = nullptr;
  int lanes_ = 1;
  std::size_t leader_ = 0;    ///< the first robot that has not diverged
  std::size_t in_lanes_ = 0;  ///< number of robots that have not diverged
  bool collide_ = false;      ///< whether any robot has collisions
  bool pairs_changed_ = false;
};

}  // namespace menger::voxel
