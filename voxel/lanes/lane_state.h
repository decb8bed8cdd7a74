#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "voxel/engine/voxel_state.h"
#include "voxel/kernels/lane_data.h"
#include "voxel/laws/lattice.h"

namespace menger::voxel {

/// Where the voxels and beams of a robot stand in the lattice that it shares with others.
struct LanePlaces {
  std::vector<std::size_t> voxel;                ///< per voxel of the robot
  std::array<std::vector<std::size_t>, 3> beam;  ///< per axis and beam of the robot

  /// @param shared of a body that has all cells of the robot's, on the same grid
  LanePlaces(const Lattice& shared, const Lattice& robot);
};

/// All arrays of robots in lanes, and the pointers to them that the kernels take. Starts with no robot in any lane.
template <class Real>
class LaneState {
 public:
  /// @param shared lattice of the union of the robots; outlives the state @param lanes 1 to most_lanes
  LaneState(const Lattice& shared, double cell_edge_m, int lanes);
  LaneState(const LaneState&) = delete;
  LaneState& operator=(const LaneState&) = delete;

  LaneData<Real> data;  ///< pointers into the arrays below

  /// Puts a robot without external loads into a lane: its coefficients, drive and state.
  void put(int lane, const StepData<Real>& robot, const LanePlaces& places);

  /// Puts the positions of a robot that is in a lane there again.
  void put_positions(int lane, const StepData<Real>& robot, const LanePlaces& places);

  /// Takes the poses of a robot out of its lane, with what rounding left out of the positions.
  void take_poses(int lane, StepData<Real>& robot, const LanePlaces& places) const;

  /// Takes motions and what beams remember out of a lane, and the poses.
  void take(int lane, StepData<Real>& robot, const LanePlaces& places) const;

  /// Makes one lane a copy of another, pairs apart.
  void copy_lane(int from, int to);

  /// Pairs (first, second) of the shared lattice per lane, each lane's in ascending order.
  using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;
  void set_pairs(std::span<const Pairs> of_lanes);

 private:
  [[nodiscard]] std::size_t at(std::size_t packs, int lane) const {
    return packs * static_cast<std::size_t>(lanes_) + static_cast<std::size_t>(lane);
  }
  void point_to_arrays(const Lattice& shared);

  int lanes_;
  AlignedArray<Real> pose_, motion_, load_, residual_, drive_, present_, voxel_coefficients_;
  std::array<AlignedArray<Real>, 3> beam_present_, beam_coefficients_, history_;
  AlignedArray<Real> pair_present_;
  std::vector<std::int32_t> pair_first_, pair_second_;
};

}  // namespace menger::voxel
