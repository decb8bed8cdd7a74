#pragma once

// The sweeps over a body whose blocks are in lanes. Included only by files that are each compiled for their own instruction set.
// Everything here is a template over the pack type, so that these files share no code.

#include "voxel/kernels/block_data.h"
#include "voxel/kernels/lane_sweep.h"

namespace menger::voxel {

namespace detail {

template <class T>
struct IndexPack {
  using Register [[gnu::vector_size(sizeof(typename T::register_type)), gnu::may_alias]] = typename LaneMoves<RealOf<T>>::Index;
};

/// Returns a pack whose lane i is lane index[i] of two packs. Lanes are counted on from the first pack to the second.
template <class T>
inline T picked(const T& a, const T& b, const typename LaneMoves<RealOf<T>>::Index* index) {
  if constexpr (NumberTraits<T>::width == 1) {
    return *index == 0 ? a : b;
  } else {
#if defined(__clang__)
    constexpr int width = NumberTraits<T>::width;
    alignas(64) RealOf<T> both[2 * width];
    alignas(64) RealOf<T> lanes[width];
    a.store_aligned(both);
    b.store_aligned(both + width);
    for (int lane = 0; lane < width; ++lane) lanes[lane] = both[index[lane]];
    return T::load_aligned(lanes);
#else
    const typename T::register_type first = a;
    const typename T::register_type second = b;
    return T(__builtin_shuffle(first, second, *reinterpret_cast<const typename IndexPack<T>::Register*>(index)));
#endif
  }
}

}  // namespace detail

/// Fills SIMD packs whose lanes come from several groups of blocks. The neighbour of a block may lie in another lane or in
/// another group.
/// @param packs `Count` packs of group 0; those of the next group lie `stride` numbers further
template <std::size_t Count, class T>
inline void gather_packs(const RealOf<T>* packs, std::size_t stride, const LaneMoves<RealOf<T>>& moves, T (&values)[Count]) {
  const auto source = [&](int s) { return packs + static_cast<std::size_t>(moves.source[s]) * stride; };
  const auto value = [&](int s, std::size_t k) {
    const std::size_t at = k * pack_stride<T>(1);
    return detail::picked<T>(load_values<T>(source(s) + at), load_values<T>(source(s + 1) + at), moves.from[s / 2]);
  };
  for (std::size_t k = 0; k < Count; ++k) values[k] = value(0, k);
  for (int s = 2; s < moves.sources; s += 2) {
    const MaskOf<T> comes = load_values<T>(moves.comes[s / 2]) > constant<T>(0.5);
    for (std::size_t k = 0; k < Count; ++k) values[k] = select(comes, value(s, k), values[k]);
  }
}

/// Returns the packs of one voxel of several blocks as a line.
/// @param packs of the voxel in the first group
template <class T>
inline Lines<T> gather_line(const RealOf<T>* packs, std::size_t group_stride, const LaneMoves<RealOf<T>>& moves) {
  Lines<T> line;
  gather_packs<line_length, T>(packs, group_stride, moves, line.value);
  return line;
}

/// Writes the loads on one end of beams along an axis into packs, in the order of their slots.
template <int Axis, class T>
inline void store_end_loads(RealOf<T>* packs, const Vector3<T>& force, const Vector3<T>& moment) {
  Lines<T> line;
  unpermute<Axis>(force, line, slot::fx);
  unpermute<Axis>(moment, line, slot::mx);
  for (int k = 0; k < 3; ++k) {
    store_values<T>(packs + pack_stride<T>(k), line.value[slot::fx + k]);
    store_values<T>(packs + pack_stride<T>(3 + k), line.value[slot::mx + k]);
  }
}

/// Computes the loads of the beams between blocks along an axis, for the packs of pairs of blocks from `first` on, before `last`.
/// @return whether a strain is out of range or not finite
template <int Axis, bool Velocity, class T>
MENGER_INLINED_WHOLE bool sweep_joints(const BlockData<RealOf<T>>& b, std::size_t first, std::size_t last) {
  using Real = RealOf<T>;
  const LaneData<Real>& d = *b.groups;
  const BlockJoints<Real>& joints = b.axis[Axis];
  const BeamCoefficients<T> c = broadcast<T>(d.beam);
  const EndInertias<T> inverse = {T(d.voxel.inverse_mass), T(d.voxel.inverse_mass), T(d.voxel.inverse_inertia),
                                  T(d.voxel.inverse_inertia)};
  MaskOf<T> out_of_range = nowhere<T>();
  for (std::size_t pack = first; pack < last; ++pack) {
    const LaneMoves<Real>& at_lower = joints.lower_block[pack];
    const LaneMoves<Real>& at_upper = joints.upper_block[pack];
    for (std::size_t face = 0; face < joints.faces; ++face) {
      const std::size_t lower = static_cast<std::size_t>(joints.lower[face]) * pack_stride<T>(line_length);
      const std::size_t upper = static_cast<std::size_t>(joints.upper[face]) * pack_stride<T>(line_length);
      const BeamEnds<T> ends = beam_ends<Axis>(gather_line<T>(d.pose + lower, b.group_stride, at_lower),
                                               gather_line<T>(d.pose + upper, b.group_stride, at_upper));
      const auto rates = [&] {
        return beam_end_rates<Axis>(inverse, gather_line<T>(d.motion + lower, b.group_stride, at_lower),
                                    gather_line<T>(d.motion + upper, b.group_stride, at_upper));
      };
      const std::size_t beam = face * joints.packs + pack;
      MaskOf<T> in_range = nowhere<T>();
      const BeamLoads<T> loads =
          pack_beam_loads<Velocity, T>(d, c, ends, rates, joints.history + beam * pack_stride<T>(history_values), in_range);
      out_of_range = out_of_range || !in_range;
      Real* on_ends = joints.loads + beam * pack_stride<T>(2 * end_loads);
      store_end_loads<Axis>(on_ends, loads.lower_force, loads.lower_moment);
      store_end_loads<Axis>(on_ends + pack_stride<T>(end_loads), -loads.lower_force, loads.upper_moment);
    }
  }
  return any(out_of_range);
}

/// Adds the loads that sweep_joints computed for the lower (0) or upper (1) ends to the voxels of a group.
template <class T>
MENGER_INLINED_WHOLE void add_joint_loads(const BlockData<RealOf<T>>& b, std::size_t axis, std::size_t end, std::size_t group) {
  using Real = RealOf<T>;
  constexpr int slots[end_loads] = {slot::fx, slot::fy, slot::fz, slot::mx, slot::my, slot::mz};
  const BlockJoints<Real>& joints = b.axis[axis];
  const LaneMoves<Real>& moves = joints.to_blocks[end][group];
  if (moves.sources == 0) return;
  const std::int32_t* voxels = end == 0 ? joints.lower : joints.upper;
  const MaskOf<T> gets = load_values<T>(moves.any) > constant<T>(0.5);
  const std::size_t stride = pack_stride<T>(2 * end_loads);
  for (std::size_t face = 0; face < joints.faces; ++face) {
    T loads[end_loads];
    gather_packs<end_loads, T>(joints.loads + face * joints.packs * stride + end * pack_stride<T>(end_loads), stride, moves,
                               loads);
    Real* voxel = b.groups[group].load + static_cast<std::size_t>(voxels[face]) * pack_stride<T>(line_length);
    for (int k = 0; k < end_loads; ++k) {
      Real* at = voxel + pack_stride<T>(slots[k]);
      const T before = load_values<T>(at);
      store_values<T>(at, select(gets, before + loads[k], before));
    }
  }
}

/// Adds the loads of the beams inside the blocks of a group along an axis.
/// @return whether a strain in one of its first `lanes` lanes is out of range or not finite
template <int Axis, bool Velocity, class T>
bool sweep_in_blocks(const LaneData<RealOf<T>>& d, int lanes) {
  const std::uint32_t bits = lane_bits<T>(sweep_lane_axis<Axis, Velocity, true, true, T>(d));
  return (bits & ((1ULL << lanes) - 1ULL)) != 0;
}

/// Writes position and size of a group's voxels into `spheres`, four numbers each, place after place and within a place lane
/// after lane.
template <class T>
MENGER_INLINED_WHOLE void put_spheres(const LaneData<RealOf<T>>& d, RealOf<T>* spheres) {
  for (std::size_t i = 0; i < d.voxels; ++i) {
    const RealOf<T>* pose = d.pose + i * pack_stride<T>(line_length);
    RealOf<T>* to = spheres + i * pack_stride<T>(4);
    if constexpr (NumberTraits<T>::width == 1) {
      for (int k = 0; k < 4; ++k) to[k] = pose[k];
    } else {
      typename T::register_type r[4];
      for (int k = 0; k < 4; ++k) r[k] = load_values<T>(pose + pack_stride<T>(k));
      for (int bit = 0; bit < 2; ++bit) detail::shuffle_stage<NumberTraits<T>::width>(r);
      for (int k = 0; k < 4; ++k) store_values<T>(to + pack_stride<T>(k), T(r[k]));
    }
  }
}

}  // namespace menger::voxel
