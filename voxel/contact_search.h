#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "voxel/collisions.h"
#include "voxel/step_data.h"

namespace menger::voxel {

/// Finds the pairs of a list whose spheres overlap.
template <class Real>
class ContactSearch {
 public:
  explicit ContactSearch(const StepKernels<Real>& kernels) : kernels_(kernels) {}

  /// Positions in list.pairs(), ascending, valid until the next call.
  /// @param first, second voxels of the list's pairs in its order, as they are numbered in `spheres` @param size_m see
  /// VerletList::candidates
  std::span<const std::int32_t> touching(const VerletList& list, const Spheres<Real>& spheres, const std::int32_t* first,
                                         const std::int32_t* second, const std::array<double, 2>& size_m);

 private:
  const StepKernels<Real>& kernels_;
  std::vector<std::int32_t> found_, touching_;
  std::vector<std::uint64_t> marks_;  ///< a bit per pair, which sorts those found
};

}  // namespace menger::voxel
