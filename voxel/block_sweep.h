#pragma once

// The sweeps over a body whose blocks are in lanes. Included only by files that are each compiled for their own instruction set:
// everything here is a template over the pack type, so that no code is shared between them.

#include "voxel/block_data.h"
#include "voxel/lane_sweep.h"

namespace menger::voxel {

namespace detail {

template <class T>
struct IndexPack {
  using Register [[gnu::vector_size(sizeof(typename T::register_type)), gnu::may_alias]] = typename LaneMoves<RealOf<T>>::Index;
};

/// Lane i of the result is lane index[i] of two packs, counted on from the first to the second.
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

/// The packs of a voxel of several blocks as a line. @param packs of the voxel in the first group
template <class T>
inline Lines<T> gather_packs(const RealOf<T>* packs, std::size_t group_stride, const LaneMoves<RealOf<T>>& moves) {
  Lines<T> line;
  const auto source = [&](int s) { return packs + static_cast<std::size_t>(moves.group[s]) * group_stride; };
  const auto value = [&](int s, int k) {
    const std::size_t at = pack_stride<T>(k);
    return detail::picked<T>(load_values<T>(source(s) + at), load_values<T>(source(s + 1) + at), moves.from[s / 2]);
  };
  for (int k = 0; k < line_length; ++k) line.value[k] = value(0, k);
  for (int s = 2; s < moves.sources; s += 2) {
    const MaskOf<T> comes = load_values<T>(moves.comes[s / 2]) > constant<T>(0.5);
    for (int k = 0; k < line_length; ++k) line.value[k] = select(comes, value(s, k), line.value[k]);
  }
  return line;
}

/// Adds a force and a moment to the loads of a voxel of several blocks. @param packs of the voxel's load in the first group
template <class T>
inline void scatter_loads(RealOf<T>* packs, std::size_t group_stride, const LaneMoves<RealOf<T>>& moves, const T (&loads)[6]) {
  constexpr int slots[6] = {slot::fx, slot::fy, slot::fz, slot::mx, slot::my, slot::mz};
  for (int s = 0; s < moves.sources; ++s) {
    RealOf<T>* load = packs + static_cast<std::size_t>(moves.group[s]) * group_stride;
    const MaskOf<T> takes = load_values<T>(moves.takes[s]) > constant<T>(0.5);
    for (int k = 0; k < 6; ++k) {
      RealOf<T>* at = load + pack_stride<T>(slots[k]);
      const T before = load_values<T>(at);
      store_values<T>(at, select(takes, before + detail::picked<T>(loads[k], loads[k], moves.to[s]), before));
    }
  }
}

/// The loads on one end of beams along an axis, in the order of their slots.
template <int Axis, class T>
inline void put_end_loads(const Vector3<T>& force, const Vector3<T>& moment, T (&loads)[6]) {
  Lines<T> line;
  unpermute<Axis>(force, line, slot::fx);
  unpermute<Axis>(moment, line, slot::mx);
  for (int k = 0; k < 3; ++k) {
    loads[k] = line.value[slot::fx + k];
    loads[3 + k] = line.value[slot::mx + k];
  }
}

/// Adds the loads on the upper ends of the beams between blocks along an axis, and keeps those on the lower ends: a voxel is to
/// get the loads of its beams in the order of their lower ends. Faces from `first` on, before `last`.
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
  for (std::size_t face = first; face < last; ++face) {
    const std::size_t lower = static_cast<std::size_t>(joints.lower[face]) * pack_stride<T>(line_length);
    const std::size_t upper = static_cast<std::size_t>(joints.upper[face]) * pack_stride<T>(line_length);
    for (std::size_t pack = 0; pack < joints.packs; ++pack) {
      const LaneMoves<Real>& at_lower = joints.lower_block[pack];
      const LaneMoves<Real>& at_upper = joints.upper_block[pack];
      const BeamEnds<T> ends = beam_ends<Axis>(gather_packs<T>(d.pose + lower, b.group_stride, at_lower),
                                               gather_packs<T>(d.pose + upper, b.group_stride, at_upper));
      const auto rates = [&] {
        return beam_end_rates<Axis>(inverse, gather_packs<T>(d.motion + lower, b.group_stride, at_lower),
                                    gather_packs<T>(d.motion + upper, b.group_stride, at_upper));
      };
      const std::size_t beam = face * joints.packs + pack;
      MaskOf<T> in_range = nowhere<T>();
      const BeamLoads<T> loads =
          pack_beam_loads<Velocity, T>(d, c, ends, rates, joints.history + beam * pack_stride<T>(history_values), in_range);
      out_of_range = out_of_range || !in_range;
      T on_end[6];
      put_end_loads<Axis>(loads.lower_force, loads.lower_moment, on_end);
      for (int k = 0; k < 6; ++k) store_values<T>(joints.kept + beam * pack_stride<T>(6) + pack_stride<T>(k), on_end[k]);
      put_end_loads<Axis>(-loads.lower_force, loads.upper_moment, on_end);
      scatter_loads<T>(d.load + upper, b.group_stride, at_upper, on_end);
    }
  }
  return any(out_of_range);
}

/// Adds the loads on the lower ends that sweep_joints kept.
template <class T>
MENGER_INLINED_WHOLE void add_kept_loads(const BlockData<RealOf<T>>& b, std::size_t axis, std::size_t first, std::size_t last) {
  using Real = RealOf<T>;
  const LaneData<Real>& d = *b.groups;
  const BlockJoints<Real>& joints = b.axis[axis];
  for (std::size_t face = first; face < last; ++face) {
    const std::size_t lower = static_cast<std::size_t>(joints.lower[face]) * pack_stride<T>(line_length);
    for (std::size_t pack = 0; pack < joints.packs; ++pack) {
      const Real* kept = joints.kept + (face * joints.packs + pack) * pack_stride<T>(6);
      T loads[6];
      for (int k = 0; k < 6; ++k) loads[k] = load_values<T>(kept + pack_stride<T>(k));
      scatter_loads<T>(d.load + lower, b.group_stride, joints.lower_block[pack], loads);
    }
  }
}

/// Adds the loads of the beams inside the blocks of a group along an axis. @return whether a strain in one of its first `lanes`
/// lanes is out of range or not finite
template <int Axis, bool Velocity, class T>
bool sweep_in_blocks(const LaneData<RealOf<T>>& d, int lanes) {
  const std::uint32_t bits = lane_bits<T>(sweep_lane_axis<Axis, Velocity, true, true, T>(d));
  return (bits & ((1ULL << lanes) - 1ULL)) != 0;
}

/// Puts position and size of a group's voxels into lines. @param voxel per place and lane: its line, or a negative number
template <class T>
MENGER_INLINED_WHOLE void put_spheres(const LaneData<RealOf<T>>& d, const std::int32_t* voxel, RealOf<T>* lines) {
  constexpr auto width = static_cast<std::size_t>(NumberTraits<T>::width);
  alignas(64) RealOf<T> values[4 * width];
  for (std::size_t i = 0; i < d.voxels; ++i) {
    const RealOf<T>* pose = d.pose + i * pack_stride<T>(line_length);
    for (std::size_t k = 0; k < 4; ++k) store_values<T>(values + k * width, load_values<T>(pose + k * width));
    for (std::size_t lane = 0; lane < width; ++lane) {
      const std::int32_t to = voxel[i * width + lane];
      if (to < 0) continue;
      RealOf<T>* line = lines + static_cast<std::ptrdiff_t>(to) * line_length;
      for (std::size_t k = 0; k < 4; ++k) line[k] = values[k * width + lane];
    }
  }
}

}  // namespace menger::voxel
