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

/// Positions of a robot's voxels and beams in the lattice that it shares with other robots.
struct LanePlaces {
  std::vector<std::size_t> voxel;                ///< per voxel of the robot
  std::array<std::vector<std::size_t>, 3> beam;  ///< per axis and beam of the robot

  /// @param shared lattice of a body that has all cells of the robot, on the same grid
  LanePlaces(const Lattice& shared, const Lattice& robot);
};

/// Memory of robots that are simulated together, one per lane: all arrays, and the pointers to them that the kernels take. At
/// first all lanes are empty.
template <class Real>
class LaneState {
 public:
  /// @param shared lattice of the union of the robots, must outlive the state @param lanes 1 to most_lanes
  LaneState(const Lattice& shared, double cell_edge_m, int lanes);
  LaneState(const LaneState&) = delete;
  LaneState& operator=(const LaneState&) = delete;

  LaneData<Real> data;  ///< pointers into the arrays below

  /// Writes a robot without external loads into a lane: its coefficients, drive and state.
  void put(int lane, const StepData<Real>& robot, const LanePlaces& places);

  /// Writes the positions of a robot into its lane again.
  void put_positions(int lane, const StepData<Real>& robot, const LanePlaces& places);

  /// Reads the poses of a robot from its lane, with the rounding residuals of the positions.
  void take_poses(int lane, StepData<Real>& robot, const LanePlaces& places) const;

  /// Reads the poses, motions and beam histories of a robot from its lane.
  void take(int lane, StepData<Real>& robot, const LanePlaces& places) const;

  /// Makes one lane a copy of another, except for its pairs.
  void copy_lane(int from, int to);

  /// Pairs (first, second) of voxels of the shared lattice that may touch in one lane, ascending.
  using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;
  /// Sets the pairs of every lane.
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
