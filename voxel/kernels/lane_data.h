#pragma once

#include <cstddef>
#include <cstdint>

#include "voxel/kernels/step_data.h"

namespace menger::voxel {

/// Number of lanes of the widest register that there is a kernel for.
inline constexpr int most_lanes = 16;

inline constexpr int voxel_values = 9;  ///< numbers of VoxelCoefficients
inline constexpr int beam_values = 14;  ///< numbers of BeamCoefficients
inline constexpr int drive_values = 3;  ///< size base, sine part, cosine part
inline constexpr std::size_t drive_size = drive_values;

/// Beams along one axis of robots in lanes. A pack holds the same beam of all robots. `present` is 1 in the lanes of the robots
/// that have the beam and 0 in the others.
template <class Real>
struct LaneBeams {
  std::size_t count = 0;
  const std::int32_t* lower = nullptr;  ///< voxel at the lower end
  const std::int32_t* upper = nullptr;
  const Real* present = nullptr;       ///< a pack per beam
  const Real* coefficients = nullptr;  ///< beam_values packs per beam
  Real* history = nullptr;             ///< history_values packs per beam
};

/// Pairs of voxels that may touch, ordered by first, then second.
template <class Real>
struct LanePairs {
  std::size_t count = 0;
  const std::int32_t* first = nullptr;
  const std::int32_t* second = nullptr;
  const Real* present = nullptr;  ///< a pack per pair
};

/// Everything that one step of several robots reads and writes, one robot per lane. Where StepData has a number, these arrays
/// have a pack, so that nothing needs to be gathered.
///
/// Voxels and beams are those of the union of the robots. A lane whose robot lacks a voxel or beam computes with meaningless
/// numbers there, which have no effect.
template <class Real>
struct LaneData : StepConstants<Real> {
  std::size_t voxels = 0;
  Real* pose = nullptr;  ///< line_length packs per voxel, see namespace slot
  Real* motion = nullptr;
  Real* load = nullptr;
  Real* position_residual = nullptr;         ///< three packs per voxel; float only
  const Real* drive = nullptr;               ///< drive_values packs per voxel
  const Real* present = nullptr;             ///< a pack per voxel: 1 or 0
  const Real* voxel_coefficients = nullptr;  ///< voxel_values packs per voxel
  VoxelCoefficients<Real> voxel;             ///< of all voxels, for uniform robots
  BeamCoefficients<Real> beam;
  LaneBeams<Real> axis[3];
  LanePairs<Real> pairs;
  alignas(64) Real floor_depth[most_lanes] = {};  ///< per lane, see StepData
  alignas(64) Real displacement_limit2[most_lanes] = {};
};

template <class Real>
struct BlockData;

/// The sweeps over robots in lanes, or over the blocks of one robot in lanes, for one instruction set and number type. Gravity,
/// floor and drive are always in the loop.
template <class Real>
struct LaneKernels {
  int lanes;
  /// Adds the loads of all beams. Returns a bit for every lane in which a strain is out of range or not finite.
  using BeamSweep = std::uint32_t (*)(const LaneData<Real>&);
  /// Moves all voxels and clears their loads. Returns a bit for every lane in which a voxel is too fast or not finite.
  /// @param largest_displacement2 m^2, per lane, aligned to 64 bytes
  using VoxelSweepFunction = std::uint32_t (*)(const LaneData<Real>&, Real* largest_displacement2);
  /// Adds the contact forces of all pairs.
  using PairSweep = void (*)(const LaneData<Real>&);
  BeamSweep beams[2][2][2];         ///< [damping from velocities][uniform][all robots have all beams]
  VoxelSweepFunction voxels[2][2];  ///< [uniform][all robots have all voxels]
  PairSweep pairs[2];               ///< [uniform]

  /// The sweeps over blocks of a uniform body, see block_sweep.h.
  using InBlocks = bool (*)(const LaneData<Real>& group, int lanes);
  using Joints = bool (*)(const BlockData<Real>&, std::size_t first_face, std::size_t last_face);
  using JointLoads = void (*)(const BlockData<Real>&, std::size_t axis, std::size_t end, std::size_t group);
  InBlocks in_blocks[2][3];  ///< [damping from velocities][axis]
  Joints joints[2][3];       ///< [damping from velocities][axis]
  JointLoads add_joint_loads;
  void (*put_spheres)(const LaneData<Real>& group, Real* spheres);
};

const LaneKernels<double>& scalar_lane_kernels_double();
const LaneKernels<float>& scalar_lane_kernels_float();
const LaneKernels<double>& sse2_lane_kernels_double();
const LaneKernels<float>& sse2_lane_kernels_float();
const LaneKernels<double>& avx2_lane_kernels_double();
const LaneKernels<float>& avx2_lane_kernels_float();
const LaneKernels<double>& avx512_lane_kernels_double();
const LaneKernels<float>& avx512_lane_kernels_float();

}  // namespace menger::voxel
