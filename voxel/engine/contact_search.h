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
/// Between two searches of the list it keeps the near pairs: those that were close to touching. Only they can touch until voxels
/// have moved or swollen by that margin.
template <class Real>
class ContactSearch {
 public:
  explicit ContactSearch(const StepKernels<Real>& kernels) : kernels_(kernels) {}

  /// Updates the near pairs so that they hold all pairs that may touch now.
  /// @param list always the same list, to which all displacements are reported (see VerletList::moved)
  /// @param first, second voxels of the list's pairs in its order, numbered as in `spheres`
  /// @param size_m see VerletList::candidates
  void prepare(const VerletList& list, const Spheres<Real>& spheres, const std::int32_t* first, const std::int32_t* second,
               const std::array<double, 2>& size_m);

  [[nodiscard]] std::size_t near_count() const { return near_.size(); }

  /// Returns the near pairs from `begin` on, before `end`, whose spheres overlap: positions in list.pairs(), ascending, stored in
  /// `room`. Threads may search separate parts at the same time.
  std::span<const std::int32_t> touching(const Spheres<Real>& spheres, std::size_t begin, std::size_t end,
                                         std::vector<std::int32_t>& room) const;

 private:
  [[nodiscard]] bool holds_all_near(const VerletList& list, const std::int32_t* first, const std::array<double, 2>& size_m) const;
  void find_near(const VerletList& list, const Spheres<Real>& spheres, const std::int32_t* first, const std::int32_t* second,
                 const std::array<double, 2>& size_m);

  const StepKernels<Real>& kernels_;
  std::vector<std::int32_t> found_;
  std::vector<std::uint64_t> marks_;  ///< a bit per pair, to sort those found

  std::vector<std::int32_t> near_;  ///< positions in the list's pairs, ascending
  /// Voxels of the near pairs, followed by as many zeros as a register may read beyond them.
  std::vector<std::int32_t> first_, second_;
  std::uint64_t number_ = 0;                   ///< VerletList::number() of the list that they come from
  const std::int32_t* numbered_as_ = nullptr;  ///< the array that the numbers of their first voxels came from
  double path_m_ = 0.0;                        ///< VerletList::path_m() when they were found
  std::array<double, 3> limits_m_{};           ///< of the distance, per kinds
};

}  // namespace menger::voxel
