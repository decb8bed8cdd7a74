#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace menger::voxel {

/// Contact of a voxel, as bits that add up.
namespace contact {
inline constexpr std::uint8_t none = 0;
inline constexpr std::uint8_t floor_sliding = 1;  ///< touches the floor, kinetic friction
inline constexpr std::uint8_t floor_static = 2;   ///< touches the floor, static friction
inline constexpr std::uint8_t other_voxel = 4;    ///< overlaps another voxel's collision sphere
}  // namespace contact

/// The state of all voxels at one time, for output. All arrays have one entry per voxel, in grid order of the body (x fastest,
/// then y, then z).
struct Frame {
  double time_s = 0.0;
  std::vector<std::array<double, 3>> position_m;         ///< centres; z = 0 is the centre of the lowest layer at rest
  std::vector<std::array<double, 3>> rest_position_m{};  ///< centres at rest, before anything has moved
  std::vector<std::array<double, 4>> orientation;        ///< unit quaternions (w, x, y, z), body to world
  std::vector<double> size_m;                            ///< driven edge length s; for a hollow voxel along z, without its bulge

  /// For drawing hollow voxels: the distances from the centre to the sides -x, +x, -y, +y, -z, +z of the turned voxel, m, as
  /// pressure drives them. A wall with nothing behind it is at its mean bulge. Empty for solid voxels, which are cubes of their
  /// size.
  std::vector<std::array<double, 6>> reach_m;
  std::vector<double> speed_m_s;  ///< magnitude of the velocity
  /// Strain of largest magnitude among the beams of a voxel, with its sign: distance of the ends over rest length, minus 1.
  std::vector<double> strain;
  std::vector<std::uint8_t> material;  ///< 1 or 2
  std::vector<double> phase;           ///< of the drive, in periods
  std::vector<std::uint8_t> contact;   ///< bits of namespace contact
  double cell_edge_m = 0.0;
};

}  // namespace menger::voxel
