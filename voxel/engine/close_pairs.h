#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "voxel/engine/collisions.h"
#include "voxel/engine/contact_search.h"
#include "voxel/kernels/kernel_choice.h"
#include "voxel/kernels/step_data.h"

namespace menger::voxel {

/// The close pairs of a body in motion, from step to step: their list, those that touch, and a count of the work.
///
/// A step lets the list be renewed where it must be (`renew`), asks whether any pair may touch (`may_touch`), and if so looks for
/// those that do (`search`); in the end it tells how far voxels moved (`moved`).
template <class Real>
class ClosePairs {
 public:
  /// @param largest_size_m of any voxel, ever @param edge_m of a voxel @param kernels outlive this @param options which work is
  /// never left out
  ClosePairs(CollisionRule rule, double largest_size_m, double edge_m, const StepKernels<Real>& kernels,
             const KernelOptions& options);

  /// Tells solid voxels of two drives apart, where there are no more, so that fewer pairs need to be looked at.
  void tell_drives_apart(const StepData<Real>& d);

  [[nodiscard]] const VerletList& list() const { return list_; }
  [[nodiscard]] const CollisionCounts& counts() const { return counts_; }

  /// See VerletList::moved.
  void moved(double displacement_m) { list_.moved(displacement_m); }

  /// Whether `renew` would look at positions.
  [[nodiscard]] bool looks_at_positions() const { return anew_in_every_step_ || list_.bound_used_up(); }

  /// Makes the list valid for the positions in these lines. @return whether it was made anew
  bool renew(const Real* pose);

  /// Makes the list anew.
  void make(const Real* pose);

  /// Whether any pair may touch in this step; to be asked once in each, after `renew`.
  [[nodiscard]] bool may_touch();

  /// The search, ready to find the pairs that touch in this step. @param first, second voxels of the list's pairs in its order,
  /// as they are numbered in `spheres` @param size_of gives the size (m) of a voxel of the body
  template <class SizeOf>
  const ContactSearch<Real>& search(const Spheres<Real>& spheres, const std::int32_t* first, const std::int32_t* second,
                                    const SizeOf& size_of) {
    search_.prepare(list_, spheres, first, second, sizes_m(size_of));
    return search_;
  }

  /// The search as it was made ready last.
  [[nodiscard]] const ContactSearch<Real>& search() const { return search_; }

 private:
  /// Sizes with which pairs are ruled out: those that voxels of the two kinds of a list have now (voxels that are driven alike
  /// are of one kind), or the largest possible size twice where kinds are not told apart.
  template <class SizeOf>
  [[nodiscard]] std::array<double, 2> sizes_m(const SizeOf& size_of) const {
    if (!of_kind_) return {largest_size_m_, largest_size_m_};
    return {static_cast<double>(size_of((*of_kind_)[0])), static_cast<double>(size_of((*of_kind_)[1]))};
  }

  VerletList list_;
  ContactSearch<Real> search_;
  double largest_size_m_;
  std::optional<std::array<std::int32_t, 2>> of_kind_;  ///< a voxel of each
  bool anew_in_every_step_, never_ruled_out_;
  CollisionCounts counts_;
};

}  // namespace menger::voxel
