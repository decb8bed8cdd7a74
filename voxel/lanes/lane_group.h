#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "voxel/engine/engine.h"
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
  /// @param robots 1 to kernels.lanes engines that run in lanes, of equal physics, time step and steps so far, not diverged; they
  /// outlive the group
  LaneGroup(const std::vector<EngineOf<Real>*>& robots, const LaneKernels<Real>& kernels);

  /// Takes `count` steps unless all robots diverge or `stop` becomes true, and puts what the lanes came to into the engines.
  void advance(std::uint64_t count, const std::atomic<bool>* stop);

 private:
  struct Robot {
    EngineOf<Real>* engine;
    LanePlaces places;
    bool in_lane = true;
  };

  static Lattice shared_lattice(const std::vector<EngineOf<Real>*>& robots);
  void choose_kernels(const LaneKernels<Real>& kernels);
  void step();
  void add_contacts();
  void renew_pairs();
  void end_step(std::size_t lane, bool out_of_range, double largest_displacement_m);
  void take_out(std::size_t lane);
  void fill_lanes();

  Lattice lattice_;
  LaneState<Real> state_;
  std::vector<Robot> robots_;  ///< per lane that was given one
  std::vector<int> pairs_of_;  ///< per lane: the robot whose pairs it has
  typename LaneKernels<Real>::BeamSweep beams_ = nullptr;
  typename LaneKernels<Real>::VoxelSweepFunction voxels_ = nullptr;
  typename LaneKernels<Real>::PairSweep pairs_ = nullptr;
  int lanes_ = 1;
  std::uint64_t steps_ = 0;
  std::size_t in_lanes_ = 0;  ///< robots that have not diverged
  bool collide_ = false;      ///< any of them
  bool pairs_changed_ = false;
};

}  // namespace menger::voxel
