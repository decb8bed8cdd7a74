#pragma once

#include <cstddef>
#include <cstdint>

#include "voxel/engine/foot_press.h"
#include "voxel/engine/wall_response.h"
#include "voxel/kernels/step_data.h"
#include "voxel/model/actuation.h"
#include "voxel/model/strain_range.h"

namespace menger::voxel {

/// What drives the sizes of a robot's voxels.
enum class SizeDrive : std::uint8_t {
  sine,   ///< a plain sine, or nothing
  shaped  ///< a sine with a ramp, or a size that is held; see is_shaped
};

/// A foot of a calibrated body as a block of threads presses it, see WallFoot.
struct DeviceFoot {
  /// Positions of the responses of the walls that make the bulge.
  struct Bulging {
    std::int32_t response[4] = {};
    std::uint32_t count = 0;

    [[nodiscard]] MENGER_HOST_DEVICE std::int32_t front() const { return response[0]; }
    [[nodiscard]] MENGER_HOST_DEVICE std::size_t size() const { return count; }
    [[nodiscard]] MENGER_HOST_DEVICE const std::int32_t* begin() const { return response; }
    [[nodiscard]] MENGER_HOST_DEVICE const std::int32_t* end() const { return response + count; }
  };

  WallFoot::Kind kind = WallFoot::Kind::corner;
  std::uint32_t axis = 0;
  double signs[3] = {};
  double share = 1.0;
  Bulging bulging;
};

/// What a calibrated body adds to RobotData. Responses are numbered as in PressureDrive::Tables.
struct CalibratedData {
  bool has_kinks = false;
  bool has_feet = false;
  bool refuses = false;                                ///< it diverges where a strain is out of the range of validity
  double smallest_strain = 0.0, largest_strain = 0.0;  ///< of that range
  double edge_m = 0.0;
  double ground_m = 0.0;    ///< height in the world
  double origin_m[3] = {};  ///< of positions, in the world
  PressureWave wave;
  std::uint32_t phases = 0;
  std::uint32_t lengths_in_use_count = 0, bulges_in_use_count = 0;

  // where its arrays begin in those of the batch
  std::size_t phase_table = 0, walls = 0, responses = 0, ranges = 0, necks_and_elbows = 0, feet = 0, touches = 0, grounds = 0;
  std::size_t beam_halves = 0;   ///< responses of the lower halves of all beams, then of the upper ones
  std::size_t entry_begin = 0;   ///< per beam, and one more
  std::size_t voxel_halves = 0;  ///< per voxel, component by component
  std::size_t foot_begin = 0;    ///< per voxel, and one more
  std::size_t lengths_in_use = 0, bulges_in_use = 0;
};

/// Most partners that the list of a voxel's possible contacts holds. A voxel of a lattice has 18 within the reach of such a list,
/// one of two layers that lie on each other about 30. A robot with more is left to the processor.
inline constexpr std::uint32_t most_partners = 64;

/// Surface voxels that follow each other are looked at for contacts together, by the box that holds them: two corners.
inline constexpr std::uint32_t voxels_of_chunk = 32;
inline constexpr std::uint32_t numbers_of_box = 6;

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
  std::size_t drives = 0;  ///< where the drives at the ends of its steps begin, after that at the start of the first one

  // contacts between voxels; none without surface voxels
  std::uint32_t surface_voxels = 0;
  std::size_t surface = 0;           ///< their voxels, ascending
  std::size_t surface_position = 0;  ///< per voxel: its position among these, or -1
  std::size_t exclusion_begin = 0;   ///< surface_voxels + 1 positions in the list of excluded partners
  std::size_t exclusions = 0;        ///< per surface voxel: the voxels that it never collides with, ascending
  std::size_t partners = 0;          ///< in the scratch memory: per surface voxel a count and most_partners voxels
  Real list_reach2 = 0;              ///< square of the distance up to which pairs are in the list, m^2
  Real half_skin = 0;                ///< the list is good until a voxel has moved so far, m
  std::size_t boxes = 0;             ///< in the scratch numbers: numbers_of_box per chunk

  std::size_t loads = 0;  ///< in the scratch numbers: numbers_of_load per voxel, where no block has them in its memory

  // where robots do not fit the memory of a block
  std::size_t beam_loads = 0;      ///< in the scratch numbers: numbers_of_load per beam, and as many for their other ends
  std::size_t beams_of_voxel = 0;  ///< per voxel: the beam of which it is the upper and the lower end, for each axis; or -1

  bool has_coupling = false;  ///< see LateralCoupling
  Real half_coupling = 0;
  std::size_t axial = 0;          ///< per beam, among the constants
  std::size_t coupling_sums = 0;  ///< in the scratch numbers: three per voxel

  CalibratedData calibrated;  ///< of calibrated bodies

  [[nodiscard]] MENGER_HOST_DEVICE std::uint32_t beams() const { return beam_begin[3]; }
  [[nodiscard]] MENGER_HOST_DEVICE std::uint32_t chunks() const {
    return (surface_voxels + voxels_of_chunk - 1) / voxels_of_chunk;
  }
};

/// Numbers of a load: a force and a moment.
inline constexpr std::uint32_t numbers_of_load = 6;

/// Beams of a voxel: above and below it along three axes.
inline constexpr std::uint32_t ends_of_voxel = 6;

/// Why a robot made no more steps.
enum class RobotEnd : std::uint8_t {
  completed,  ///< all steps were made
  strained,   ///< in its last step a strain was out of range; that step ended before voxels moved
  outside,    ///< in its last step a strain left the range of validity; that step ended before voxels moved
  too_fast,   ///< in its last step a voxel was too fast, or not finite
  crowded     ///< after its last step a voxel had more possible contacts than the list holds
};

struct RobotOutcome {
  std::uint32_t steps = 0;  ///< made, with one that was cut short
  RobotEnd end = RobotEnd::completed;
  double middle_m[3] = {0.0, 0.0, 0.0};  ///< mean of the positions, from the origin
  StrainRange strains;                   ///< of a calibrated body in these steps
};

/// Which steps a launch takes, and with how many threads for each of its robots.
struct LaunchShape {
  bool velocity = false;  ///< damping is from velocities
  /// own_lengths also for bodies with kinks, and uniform only for bodies without lateral coupling
  BeamVariety variety = BeamVariety::classes;
  bool in_block = false;        ///< poses, motions and loads lie in the memory of a block: those of all robots of the batch fit
  std::uint32_t blocks = 1;     ///< that share a robot, a power of two; fewer where the device does not have so many together
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
  const DriveMoment* drives = nullptr;
  std::int32_t* partners = nullptr;
  Real* loads = nullptr;

  // of calibrated bodies
  const double* phases = nullptr;  ///< cosine and sine each
  const WallLaws* walls = nullptr;
  const NeckOrElbow* necks_and_elbows = nullptr;
  const DeviceFoot* feet = nullptr;
  const VoxelCoefficients<double>* grounds = nullptr;  ///< per class of voxels
  WallResponse* responses = nullptr;
  double* ranges = nullptr;
  FootGrip* grips = nullptr;         ///< per foot; changed by steps
  std::uint32_t* touches = nullptr;  ///< per voxel: touches_ground and sticks_to_ground; changed by steps
};

inline constexpr std::uint32_t touches_ground = 1, sticks_to_ground = 2;

/// Most threads of a block. With more, each has too few registers for the law of a beam.
inline constexpr std::uint32_t most_block_threads = 256;
/// Most blocks that share a robot.
inline constexpr std::uint32_t most_blocks = 16;

}  // namespace menger::voxel
