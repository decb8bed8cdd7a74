#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "voxel/engine/moving_body.h"
#include "voxel/kernels/lane_data.h"
#include "voxel/lanes/lane_state.h"

namespace menger::voxel {

/// Up to as many robots as a register has lanes, stepped together; every one comes to the same bytes as alone.
///
/// A robot that diverges is taken out at the end of its step, and its lane goes on as a copy of another: nothing that is not
/// finite stays in a register.
template <class Real>
class LaneGroup {
 public:
  /// @param robots 1 to kernels.lanes bodies that run in lanes, of equal physics, time step and steps so far, not diverged; they
  /// outlive the group
  LaneGroup(const std::vector<MovingBody<Real>*>& robots, const LaneKernels<Real>& kernels);

  /// Takes `count` steps unless all robots diverge or `stop` becomes true, and puts what the lanes came to into the robots.
  void advance(std::uint64_t count, const std::atomic<bool>* stop);

 private:
  struct Robot {
    MovingBody<Real>* moving;
    LanePlaces places;
    bool in_lane = true;
  };

  /// One robot's lane, see MovingBody::end_step.
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
  std::vector<Robot> robots_;  ///< per lane that was given one
  std::vector<int> pairs_of_;  ///< per lane: the robot whose pairs it has
  typename LaneKernels<Real>::BeamSweep beams_ = nullptr;
  typename LaneKernels<Real>::VoxelSweepFunction voxels_ = nullptr;
  typename LaneKernels<Real>::PairSweep pairs_ = nullptr;
  int lanes_ = 1;
  std::size_t leader_ = 0;    ///< the first robot that has not diverged
  std::size_t in_lanes_ = 0;  ///< robots that have not
  bool collide_ = false;      ///< any of them
  bool pairs_changed_ = false;
};

}  // namespace menger::voxel
