#pragma once

#include <cstddef>
#include <cstdint>

#include "voxel/laws/beam.h"
#include "voxel/laws/ground.h"

namespace menger::voxel {

/// Number of values in a line. The pose of a voxel, its motion and its load, as far as a beam needs them, are one line of eight
/// numbers each: for double one cache line. A pack kernel reads a line per lane and turns them into eight packs in registers.
/// That is faster than gathering component by component.
inline constexpr int line_length = 8;
inline constexpr std::size_t line_size = line_length;  ///< line_length for indices of arrays

/// Positions of values in the lines of a voxel.
namespace slot {
inline constexpr int x = 0, y = 1, z = 2, size = 3, qw = 4, qx = 5, qy = 6, qz = 7;  ///< pose: m from the origin, quaternion
inline constexpr int px = 0, py = 1, pz = 2, size_rate = 3, hx = 4, hy = 5, hz = 6,
                     is_static = 7;                                   ///< motion: kg m/s, m/s, kg m^2/s, 0 or 1
inline constexpr int fx = 0, fy = 1, fz = 2, mx = 4, my = 5, mz = 6;  ///< load: N, N m; the others stay 0
}  // namespace slot

/// Positions of those values in a row of the voxel table that are read one by one. The order is that of VoxelCoefficients.
namespace class_slot {
inline constexpr int inverse_mass = 0, inverse_inertia = 1, contact_stiffness = 5, contact_damping = 6;
}  // namespace class_slot

/// Coefficients of a voxel, the same for all voxels of a class (material, fixed or free).
template <class T>
struct VoxelCoefficients {
  T inverse_mass;             ///< 1/kg, 0 for a fixed voxel
  T inverse_inertia;          ///< 1/(kg m^2), 0 for a fixed voxel
  T weight;                   ///< m g, N
  T global_damping;           ///< c_g = 2 zeta_g sqrt(m E L), N s/m
  T global_rotation_damping;  ///< c_gr = 2 zeta_g sqrt(I E L^3), N m s/rad
  FloorCoefficients<T> floor;
};

inline constexpr int history_values = 9;  ///< numbers of a BeamHistory
inline constexpr std::size_t history_size = history_values;
inline constexpr int class_values = 16;  ///< numbers of a voxel or beam class in the tables, two lines

/// Return the coefficients from the numbers of a row of a table, in its order.
/// @param value (position in the row) -> number
template <class T, class Value>
MENGER_HOST_DEVICE inline VoxelCoefficients<T> voxel_coefficients_from(const Value& value) {
  return {value(0), value(1), value(2), value(3), value(4), {value(5), value(6), value(7), value(8)}};
}
template <class T, class Value>
MENGER_HOST_DEVICE inline BeamCoefficients<T> beam_coefficients_from(const Value& value) {
  return {value(0), value(1), value(2), value(3),  value(4),  value(5),  value(6),
          value(7), value(8), value(9), value(10), value(11), value(12), value(13)};
}

/// Count of numbers in the widest register. Beams and voxels are padded to a multiple of it.
template <class Real>
inline constexpr std::size_t widest_pack = 64 / sizeof(Real);

/// Beams along one axis, in the order of their lower voxel. They are padded with beams between two extra voxels that are not part
/// of the body.
template <class Real>
struct BeamAxisData {
  std::size_t count = 0;                ///< with padding
  const std::int32_t* lower = nullptr;  ///< voxel at the lower end
  const std::int32_t* upper = nullptr;
  const std::int32_t* beam_class = nullptr;  ///< row pair in the beam table
  Real* history = nullptr;                   ///< history_values arrays of `count`

  /// Rest lengths (m) and their rates (m/s), where beams have their own. Null where they are the means of the sizes of the ends.
  Real* rest_length = nullptr;
  Real* rest_length_rate = nullptr;

  /// Half the kinks of beams (see kink): four arrays of `count` with the turns about the two axes after the beam's own (rad) and
  /// their rates (rad/s). Null where no beam has a kink.
  Real* half_kink = nullptr;
};

/// Constants of a step that all voxels and beams share.
template <class Real>
struct StepConstants {
  Real time_step = 0;   ///< h, s
  Real rate_scale = 0;  ///< 1/h for damping from increments, 0 in the first step
  Real next_sine = 0;   ///< sin(2 pi t/T) at the end of the step
  Real next_cosine = 0;
  Real angular_frequency = 0;  ///< 2 pi / T, rad/s
  Real strain_limit = 0;
  bool stop_rotation_in_static_friction = false;
  bool single_precision_rest_lengths = false;
  bool balances_moments = false;  ///< whether the moments of beams balance their forces; see balanced
};

/// Everything that one step of one body reads and writes: plain arrays and constants, the same for every instruction set.
template <class Real>
struct StepData : StepConstants<Real> {
  std::size_t voxels = 0;         ///< number of voxels of the body
  std::size_t padded_voxels = 0;  ///< the same with padding
  Real* pose = nullptr;           ///< lines, see namespace slot
  Real* motion = nullptr;
  Real* load = nullptr;
  Real* position_residual = nullptr;    ///< lines x, y, z: rounding error of the positions; float only
  const Real* external_load = nullptr;  ///< lines, or null
  const Real* size_base = nullptr;      ///< size = base + sine part * sin(2 pi t/T) + cosine part * cos(2 pi t/T), m
  const Real* size_sine_part = nullptr;
  const Real* size_cosine_part = nullptr;
  const std::int32_t* voxel_class = nullptr;  ///< row pair in the voxel table
  const Real* voxel_table = nullptr;          ///< class_values numbers per class
  const Real* beam_table = nullptr;
  VoxelCoefficients<Real> voxel;  ///< of all voxels, for uniform bodies
  BeamCoefficients<Real> beam;    ///< of all beams, for uniform bodies
  BeamAxisData<Real> axis[3];
  Real floor_depth = 0;          ///< of the floor below z = 0 of the positions, m
  Real displacement_limit2 = 0;  ///< (speed limit * h)^2, m^2
};

/// Returns the rest length (m) of a beam in this step, as the kernels compute it.
template <class Real>
inline Real rest_length_m(const StepData<Real>& d, std::size_t axis, std::size_t beam) {
  const BeamAxisData<Real>& beams = d.axis[axis];
  const auto size = [&](std::int32_t voxel) { return d.pose[static_cast<std::ptrdiff_t>(voxel) * line_length + slot::size]; };
  const Real length =
      beams.rest_length != nullptr ? beams.rest_length[beam] : Real(0.5) * (size(beams.lower[beam]) + size(beams.upper[beam]));
  return d.single_precision_rest_lengths ? rounded_to_single(length) : length;
}

/// Result of a sweep over voxels.
struct VoxelSweep {
  bool out_of_range = false;           ///< a voxel is too fast or not finite
  double largest_displacement2 = 0.0;  ///< m^2 in this step
};

/// Positions of voxels, and their sizes in contacts with each other.
template <class Real>
struct Spheres {
  const Real* values = nullptr;  ///< of voxel i from values[stride * i] on: x, y, z, size; m
  std::ptrdiff_t stride = line_length;
};

/// Returns the spheres of a body whose voxels are stored in lines.
template <class Real>
inline Spheres<Real> spheres_of(const StepData<Real>& d) {
  return {d.pose, line_length};
}

/// Returns the size (m) of a voxel in this step.
template <class Real>
inline Real size_m(const StepData<Real>& d, std::size_t voxel) {
  return d.pose[line_size * voxel + slot::size];
}

/// How the beams of a body differ. A kernel reads no more than that.
enum class BeamVariety {
  classes,      ///< coefficients per beam, rest lengths from the sizes of the ends
  uniform,      ///< one set of coefficients
  own_lengths,  ///< coefficients and rest lengths per beam
  own_kinks     ///< and kinks
};

/// Whether beams have rest lengths of their own, and shear.
constexpr bool has_own_lengths(BeamVariety variety) {
  return variety == BeamVariety::own_lengths || variety == BeamVariety::own_kinks;
}

/// The sweeps of one instruction set and number type, by the terms that they contain.
template <class Real>
struct StepKernels {
  using BeamSweep =
      bool (*)(const StepData<Real>&);  ///< adds the loads of all beams; true if a strain is out of range or not finite
  using VoxelSweepFunction = VoxelSweep (*)(const StepData<Real>&);  ///< moves all voxels and resets their loads
  BeamSweep beams[2][4];                                             ///< [damping from velocities][BeamVariety]
  VoxelSweepFunction voxels[2][2][2][2];                             ///< [uniform][floor][gravity][actuated]

  /// Finds the pairs (first, second) whose spheres overlap. Writes their positions, ascending, into `positions`, which has room
  /// for `count` numbers and a register's width more. `first` and `second` must be readable that far, too.
  /// @return number of pairs found
  std::size_t (*touching)(const Spheres<Real>&, const std::int32_t* first, const std::int32_t* second, std::size_t count,
                          std::int32_t* positions);

  /// Finds the pairs whose centres are closer than `limit` (m), in the same way.
  std::size_t (*closer)(const Spheres<Real>&, const std::int32_t* first, const std::int32_t* second, std::size_t count,
                        Real limit, std::int32_t* positions);
};

/// Return the sweeps of one instruction set. The pack versions exist only where the compiler can make them (x86-64).
const StepKernels<double>& scalar_kernels_double();
const StepKernels<float>& scalar_kernels_float();
const StepKernels<double>& sse2_kernels_double();
const StepKernels<float>& sse2_kernels_float();
const StepKernels<double>& avx2_kernels_double();
const StepKernels<float>& avx2_kernels_float();
const StepKernels<double>& avx512_kernels_double();
const StepKernels<float>& avx512_kernels_float();

}  // namespace menger::voxel
