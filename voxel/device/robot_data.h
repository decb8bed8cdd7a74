#pragma once

#include <cstddef>
#include <cstdint>

#include "voxel/kernels/step_data.h"

namespace menger::voxel {

/// What drives the sizes of a robot's voxels.
enum class SizeDrive : std::uint8_t {
  sine,   ///< a plain sine, or nothing
  shaped  ///< a sine with a ramp, or a size that is held; see is_shaped
};

/// The drive at the end of a step, see DriveMoment.
struct StepDrive {
  double sine = 0.0, cosine = 1.0, sine_rate = 0.0, cosine_rate = 0.0;
};

/// Most partners that the list of a voxel's possible contacts holds. A voxel of a lattice has 18 within the reach of such a list,
/// one of two layers that lie on each other about 30. A robot with more is left to the processor.
inline constexpr std::uint32_t most_partners = 64;

/// A robot as a block of threads steps it: its sizes and constants, and where its arrays begin in those of the batch
/// (BatchArrays).
///
/// Values of voxels and beams lie component by component, so that threads side by side read numbers side by side: component k of
/// voxel i is at `stride * k + i`, of a beam at `beams() * k + i`. Beams of all axes are numbered through.
template <class Real>
struct RobotData : StepConstants<Real> {
  std::uint32_t voxels = 0;
  std::uint32_t stride = 0;  ///< voxels with padding
  std::uint32_t beam_begin[4] = {0, 0, 0, 0};
  SizeDrive size_drive = SizeDrive::sine;
  bool is_first_step = false;  ///< no step was made before: damping from increments has no last step
  Real floor_depth = 0;        ///< see StepData
  Real displacement_limit2 = 0;
  VoxelCoefficients<Real> voxel{};  ///< of uniform bodies
  BeamCoefficients<Real> beam{};

  // where arrays of numbers begin
  std::size_t pose = 0, motion = 0;  ///< line_length values per voxel, see namespace slot
  std::size_t history = 0;           ///< history_values per beam
  std::size_t residual = 0;          ///< three values per voxel; float only
  std::size_t size_parts = 0;        ///< three values per voxel: base, sine part and cosine part, see StepData
  std::size_t external = 0;          ///< numbers_of_load per voxel, where has_external
  std::size_t voxel_table = 0, beam_table = 0;
  bool has_external = false;

  // where arrays of indices begin
  std::size_t lower = 0, upper = 0, beam_class = 0, voxel_class = 0;
  std::size_t drives = 0;  ///< where its StepDrives begin, one per step

  // contacts between voxels; none without surface voxels
  std::uint32_t surface_voxels = 0;
  std::size_t surface = 0;          ///< their voxels, ascending
  std::size_t exclusion_begin = 0;  ///< surface_voxels + 1 positions in the list of excluded partners
  std::size_t exclusions = 0;       ///< per surface voxel: the voxels that it never collides with, ascending
  std::size_t partners = 0;         ///< in the scratch memory: per surface voxel a count and most_partners voxels
  Real list_reach2 = 0;             ///< square of the distance up to which pairs are in the list, m^2
  Real half_skin = 0;               ///< the list is good until a voxel has moved so far, m

  std::size_t loads = 0;  ///< in the scratch numbers: numbers_of_load per voxel, where they do not fit the block's own memory

  [[nodiscard]] MENGER_HOST_DEVICE std::uint32_t beams() const { return beam_begin[3]; }
};

/// Numbers of a load: a force and a moment.
inline constexpr std::uint32_t numbers_of_load = 6;

/// Why a robot made no more steps.
enum class RobotEnd : std::uint8_t {
  completed,  ///< all steps were made
  strained,   ///< in its last step a strain was out of range; that step ended before voxels moved
  too_fast,   ///< in its last step a voxel was too fast, or not finite
  crowded     ///< after its last step a voxel had more possible contacts than the list holds
};

struct RobotOutcome {
  std::uint32_t steps = 0;  ///< made, with one that was cut short
  RobotEnd end = RobotEnd::completed;
  double middle_m[3] = {0.0, 0.0, 0.0};  ///< mean of the positions, from the origin
};

/// Which steps a launch takes, and with how many threads for each of its robots.
struct LaunchShape {
  bool velocity = false;        ///< damping is from velocities
  bool uniform = false;         ///< one set of coefficients
  bool in_block = false;        ///< poses, motions and loads fit the memory of a block
  std::uint32_t threads = 32;   ///< of a block, a multiple of 32
  std::size_t block_bytes = 0;  ///< memory of a block

  bool operator==(const LaunchShape&) const = default;
};

/// The arrays of a batch of robots, in the memory of the processor that steps them.
template <class Real>
struct BatchArrays {
  const RobotData<Real>* robots = nullptr;
  const std::uint32_t* steps = nullptr;  ///< to make, per robot
  RobotOutcome* outcomes = nullptr;      ///< per robot
  Real* state = nullptr;                 ///< what steps change: pose, motion, history, residual
  const Real* constants = nullptr;       ///< size_parts, external, voxel_table, beam_table
  const std::int32_t* indices = nullptr;
  const StepDrive* drives = nullptr;
  std::int32_t* partners = nullptr;
  Real* loads = nullptr;
};

}  // namespace menger::voxel
