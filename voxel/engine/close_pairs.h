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

/// The close pairs of a body in motion, from step to step: their list, the pairs that touch, and counts of the work.
///
/// A step renews the list where it must (`renew`), asks whether any pair may touch (`may_touch`), and if so finds those that do
/// (`search`). At its end it reports how far voxels moved (`moved`).
template <class Real>
class ClosePairs {
 public:
  /// @param largest_size_m largest size of any voxel at any time
  /// @param edge_m of a voxel
  /// @param kernels must outlive this object
  /// @param options which work is never left out
  ClosePairs(CollisionRule rule, double largest_size_m, double edge_m, const StepKernels<Real>& kernels,
             const KernelOptions& options);

  /// Sorts solid voxels into two kinds by their drive, if there are no more than two drives. Fewer pairs then need to be looked
  /// at.
  void tell_drives_apart(const StepData<Real>& d);

  [[nodiscard]] double largest_size_m() const { return largest_size_m_; }
  [[nodiscard]] const VerletList& list() const { return list_; }
  [[nodiscard]] const CollisionCounts& counts() const { return counts_; }

  /// See VerletList::moved.
  void moved(double displacement_m) { list_.moved(displacement_m); }

  /// Whether `renew` would read positions.
  [[nodiscard]] bool looks_at_positions() const { return anew_in_every_step_ || list_.bound_used_up(); }

  /// Makes the list valid for the positions in these lines.
  /// @return whether it was built anew
  bool renew(const Real* pose);

  /// Builds the list anew.
  void make(const Real* pose);

  /// Whether any pair may touch in this step. Call it once in each step, after `renew`.
  [[nodiscard]] bool may_touch();

  /// Prepares the search for the pairs that touch in this step, and returns it.
  /// @param first, second voxels of the list's pairs in its order, numbered as in `spheres`
  /// @param size_of (voxel of the body) -> its size (m)
  template <class SizeOf>
  const ContactSearch<Real>& search(const Spheres<Real>& spheres, const std::int32_t* first, const std::int32_t* second,
                                    const SizeOf& size_of) {
    search_.prepare(list_, spheres, first, second, sizes_m(size_of));
    return search_;
  }

  /// Returns the search as it was last prepared.
  [[nodiscard]] const ContactSearch<Real>& search() const { return search_; }

 private:
  /// Returns the two sizes with which pairs are ruled out. They are the present sizes of the voxels of the two kinds (voxels that
  /// are driven alike are of one kind). Where kinds are not told apart, both are the largest possible size.
  template <class SizeOf>
  [[nodiscard]] std::array<double, 2> sizes_m(const SizeOf& size_of) const {
    if (!of_kind_) return {largest_size_m_, largest_size_m_};
    return {static_cast<double>(size_of((*of_kind_)[0])), static_cast<double>(size_of((*of_kind_)[1]))};
  }

  VerletList list_;
  ContactSearch<Real> search_;
  double largest_size_m_;
  std::optional<std::array<std::int32_t, 2>> of_kind_;  ///< a voxel of each kind
  bool anew_in_every_step_, never_ruled_out_;
  CollisionCounts counts_;
};

}  // namespace menger::voxel
