#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

#include "voxel/engine/moving_body.h"
#include "voxel/kernels/block_data.h"
#include "voxel/lanes/blocks.h"
#include "voxel/lanes/spin_barrier.h"

namespace menger::voxel {

/// Steps an aggregate whose blocks lie in SIMD lanes. The results are the same bytes as voxel by voxel.
///
/// All copies of a block have the same beams in the same order. One pack therefore holds the same voxel or beam of several
/// blocks, and only the ends of beams between blocks must be sorted into registers. For uniform bodies that run in lanes (see
/// runs_in_lanes).
template <class Real>
class BlockLanes {
 public:
  /// @param moving must outlive this object @param body the blocks of the moving body @param kernels with more than one lane
  /// @param threads number of threads that share every step, >= 1
  BlockLanes(MovingBody<Real>& moving, BlockBody body, const LaneKernels<Real>& kernels, int threads);
  BlockLanes(const BlockLanes&) = delete;
  BlockLanes& operator=(const BlockLanes&) = delete;

  /// Sets how many threads share every step from now on. @param threads >= 1
  void set_threads(int threads);

  /// Takes `count` steps unless the robot diverges or `stop` becomes true, and writes the resulting state into the moving body.
  void advance(std::uint64_t count, const std::atomic<bool>* stop);

 private:
  /// A contact force on a voxel.
  struct Contact {
    std::size_t at = 0;  ///< index in load_ of the x component of the voxel's force
    Vector3<Real> force;
  };

  /// One thread's share of the steps, with its results of the last step.
  struct alignas(64) Part {
    std::size_t number = 0;
    bool strained = false;
    VoxelSweep seen;
    std::vector<std::vector<Contact>> contacts;  ///< found by this thread, per group, in the order of their pairs
    std::vector<std::int32_t> touching;          ///< working memory of the contact search
    std::exception_ptr failure;
  };

  /// The range [first, last) of `count` items that a part works on.
  [[nodiscard]] std::pair<std::size_t, std::size_t> share(std::size_t count, const Part& part) const {
    return {count * part.number / parts_.size(), count * (part.number + 1) / parts_.size()};
  }

  /// The lanes as MovingBody::end_step needs them.
  struct Lanes {
    BlockLanes& blocks;

    void take() const { blocks.take(); }
    void take_poses() const { blocks.take_poses(); }
    void put_positions() const { blocks.put_positions(); }
  };

  void allocate();
  void join(std::size_t axis);
  void find_histories(std::size_t axis);
  void put();
  void put_positions();
  void put_histories();
  void take_poses();
  void take();
  void begin_step();
  bool prepare_contacts();
  void take_positions();
  void number_spheres();
  void put_spheres(std::size_t group);
  void find_contacts(Part& part);
  void add_contacts(std::size_t group);
  void find_joint_loads(Part& part);
  void move_groups(Part& part);
  void end_step();
  void do_alone(void (BlockLanes::*work)());
  void do_part(Part& part);

  /// Index of a number of a voxel, in an array with a fixed number of packs per voxel.
  [[nodiscard]] std::size_t at(std::size_t slot, std::size_t place, std::size_t packs, std::size_t pack) const {
    return ((slot / lanes_ * places_ + place) * packs + pack) * lanes_ + slot % lanes_;
  }
  [[nodiscard]] std::size_t lanes_used(std::size_t group) const;
  [[nodiscard]] Spheres<Real> spheres() const { return {spheres_.data(), 4}; }

  MovingBody<Real>& moving_;
  BlockBody body_;
  Lattice block_;
  const LaneKernels<Real>& kernels_;
  /// Slots are lanes over all groups: one per block, and lanes left over. Those start as copies of the first block, and their
  /// numbers are ignored.
  std::size_t lanes_, places_, slots_;
  AlignedArray<Real> pose_, motion_, load_, residual_, drive_;
  std::array<AlignedArray<Real>, 3> history_, joint_history_, joint_loads_;
  std::array<std::vector<std::int32_t>, 3> face_lower_, face_upper_;
  using Moves = std::vector<LaneMoves<Real>, xsimd::aligned_allocator<LaneMoves<Real>, 64>>;
  std::array<Moves, 3> lower_blocks_, upper_blocks_;
  std::array<std::array<Moves, 2>, 3> to_blocks_;  ///< per axis and end of a beam (0 lower, 1 upper)
  std::vector<LaneData<Real>, xsimd::aligned_allocator<LaneData<Real>, 64>> groups_;
  BlockData<Real> data_;

  std::vector<std::size_t> line_of_;          ///< index of a voxel's first number in arrays of line_length packs per voxel
  std::vector<std::int32_t> sphere_of_;       ///< index of a voxel's sphere
  AlignedArray<Real> spheres_;                ///< four numbers per voxel, after the last step
  std::vector<std::int32_t> first_, second_;  ///< spheres of the close pairs, in the order of the pairs
  std::uint64_t list_of_spheres_ = 0;         ///< number of the list that first_ and second_ come from
  bool may_touch_ = false;                    ///< whether any pair may touch in this step

  std::vector<Part, xsimd::aligned_allocator<Part, 64>> parts_;  ///< one per thread
  SpinBarrier barrier_;
  bool done_ = false;           ///< whether no further step is to be taken
  std::exception_ptr failure_;  ///< thrown by work that one thread does alone
  std::uint64_t last_step_ = 0;
  const std::atomic<bool>* stop_ = nullptr;

  /// Per axis and beam of the body: pointer to the history of the beam. Its remembered values are one pack apart.
  std::array<std::vector<Real*>, 3> remembered_;
  std::array<std::vector<std::pair<Real*, Real*>>, 3> repeated_;  ///< history of a lane left over, and the history that it copies
};

}  // namespace menger::voxel
