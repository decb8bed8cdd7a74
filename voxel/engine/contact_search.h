#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "voxel/engine/collisions.h"
#include "voxel/kernels/step_data.h"

namespace menger::voxel {

/// Finds the pairs of a list whose spheres overlap.
///
/// Between two looks at the list it keeps the pairs that were near to touching, which are the only ones that may touch until
/// voxels have moved or swollen by as much as that.
template <class Real>
class ContactSearch {
 public:
  explicit ContactSearch(const StepKernels<Real>& kernels) : kernels_(kernels) {}

  /// Makes the near pairs hold all that may touch now. Of one list, which is told of all displacements (see VerletList::moved).
  /// @param first, second voxels of the list's pairs in its order, as they are numbered in `spheres` @param size_m see
  /// VerletList::candidates
  void prepare(const VerletList& list, const Spheres<Real>& spheres, const std::int32_t* first, const std::int32_t* second,
               const std::array<double, 2>& size_m);

  [[nodiscard]] std::size_t near_count() const { return near_.size(); }

  /// Those of the near pairs from `begin` on, before `end`, whose spheres overlap: positions in list.pairs(), ascending, in
  /// `room`. Threads may look at parts of their own.
  std::span<const std::int32_t> touching(const Spheres<Real>& spheres, std::size_t begin, std::size_t end,
                                         std::vector<std::int32_t>& room) const;

 private:
  [[nodiscard]] bool holds_all_near(const VerletList& list, const std::int32_t* first, const std::array<double, 2>& size_m) const;
  void find_near(const VerletList& list, const Spheres<Real>& spheres, const std::int32_t* first, const std::int32_t* second,
                 const std::array<double, 2>& size_m);

  const StepKernels<Real>& kernels_;
  std::vector<std::int32_t> found_;
  std::vector<std::uint64_t> marks_;  ///< a bit per pair, which sorts those found

  std::vector<std::int32_t> near_;             ///< positions in the list's pairs, ascending
  std::vector<std::int32_t> first_, second_;   ///< of these, followed by as many zeros as a register may read beyond them
  std::uint64_t number_ = 0;                   ///< of the list that they are of
  const std::int32_t* numbered_as_ = nullptr;  ///< where the numbers of their first voxels came from
  double way_m_ = 0.0;                         ///< of its voxels when they were found
  std::array<double, 3> limits_m_{};           ///< of the distance, per kinds
};

}  // namespace menger::voxel
