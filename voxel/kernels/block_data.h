#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "voxel/kernels/lane_data.h"

namespace menger::voxel {

/// How a pack is put together from lanes of other packs.
template <class Real>
struct LaneMoves {
  /// Integers as wide as the numbers that they move.
  using Index = std::conditional_t<sizeof(Real) == sizeof(double), std::int64_t, std::int32_t>;

  int sources = 0;                    ///< packs that the lanes come from
  std::int32_t source[most_lanes]{};  ///< these packs; of an odd number the last stands twice

  /// Per pair of sources and lane: the lane that it comes from. The lanes of the second source are counted on from those of the
  /// first.
  alignas(64) Index from[most_lanes / 2][most_lanes]{};
  alignas(64) Real comes[most_lanes / 2][most_lanes]{};  ///< 1 where the lane comes from these two sources
  alignas(64) Real any[most_lanes]{};                    ///< 1 where the lane comes from any source
};

inline constexpr int end_loads = 6;  ///< packs of a force and a moment

/// Beams between neighbouring blocks along one axis. Every pair of blocks has as many of them as their faces have cells in
/// common. The lanes of a pack are pairs of blocks. Left-over lanes repeat the last pair, and their loads are not used.
template <class Real>
struct BlockJoints {
  std::size_t faces = 0;
  const std::int32_t* lower = nullptr;  ///< per face: voxel of the lower block
  const std::int32_t* upper = nullptr;
  std::size_t packs = 0;                         ///< of pairs of blocks
  const LaneMoves<Real>* lower_block = nullptr;  ///< per pack, from groups of blocks
  const LaneMoves<Real>* upper_block = nullptr;
  Real* history = nullptr;  ///< history_values packs per face and pack
  Real* loads = nullptr;    ///< force and moment on the lower, then on the upper ends: twelve packs per face and pack

  /// Per lower (0) or upper (1) end and group of blocks: the packs of pairs from which its lanes take their loads.
  const LaneMoves<Real>* to_blocks[2] = {};
};

/// A body of equal blocks, one block per lane. Every group of as many blocks as a register has lanes is a LaneData of its own.
/// The poses of all groups are stored one after the other, and likewise their motions and their loads.
template <class Real>
struct BlockData {
  const LaneData<Real>* groups = nullptr;
  std::size_t group_stride = 0;  ///< numbers between the poses (motions, loads) of two groups
  BlockJoints<Real> axis[3];
};

}  // namespace menger::voxel
