#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "voxel/kernels/step_data.h"
#include "voxel/laws/lattice.h"
#include "voxel/laws/voxel_contact.h"

namespace menger::voxel {

/// Decides which pairs of voxels of a lattice may collide. Both must be surface voxels. The shortest way between them along beams
/// must be longer than `exclusion_depth` beams, or there is no way at all. The lattice must outlive the rule.
class CollisionRule {
 public:
  /// @param exclusion_depth >= 1
  CollisionRule(const Lattice& lattice, int exclusion_depth);

  [[nodiscard]] const std::vector<std::int32_t>& surface() const { return surface_; }

  /// Whether no two surface voxels may ever collide. The simulation then need not look for collisions.
  [[nodiscard]] bool excludes_every_pair() const { return excludes_every_pair_; }

  /// Returns the voxels that may not collide with `voxel`, itself among them, ascending.
  [[nodiscard]] std::vector<std::int32_t> excluded(std::int32_t voxel);

  /// Removes from `candidates` the voxels that may not collide with `voxel`, and keeps the order of the others.
  /// @param candidates voxels with numbers above `voxel`
  void keep_allowed(std::int32_t voxel, std::vector<std::int32_t>& candidates);

 private:
  void mark_within_depth(std::int32_t voxel);

  const std::vector<std::array<std::int32_t, 6>>* neighbours_;
  int exclusion_depth_;
  bool excludes_every_pair_ = false;
  std::vector<std::int32_t> surface_;
  std::vector<std::uint32_t> mark_;  ///< per voxel: number of the last search that reached it
  std::uint32_t search_ = 0;
  std::vector<std::int32_t> queue_;
};

/// Verlet list: all pairs that may collide and are closer than reach + skin. They are found on a uniform grid. The list is kept
/// until the displacements since then could have brought another pair into reach. A part of a body may move any distance together
/// with everything near it.
class VerletList {
 public:
  /// @param reach_m largest distance of the centres at which two voxels can overlap
  /// @param skin_m > 0
  VerletList(CollisionRule rule, double reach_m, double skin_m);

  /// Builds the list from positions (x, y, z of voxel i at positions[stride * i + 0, 1, 2]).
  template <class Real>
  void build(const Real* positions, std::size_t stride);

  /// Reports the largest distance that any voxel may have moved in a step, m. The list is made anew when these displacements add
  /// up to too much.
  void moved(double displacement_m) {
    bound_m_ += displacement_m;
    path_m_ += displacement_m;
  }

  /// Returns the sum of all displacements reported to `moved`, m.
  [[nodiscard]] double path_m() const { return path_m_; }

  /// Returns how often the list was built.
  [[nodiscard]] std::uint64_t number() const { return number_; }

  /// Whether refresh would read positions.
  [[nodiscard]] bool bound_used_up() const { return !built_ || bound_m_ > 0.5 * skin_m_; }

  /// Makes the list valid for these positions. The sum of the largest displacements of each step is a cheap bound. When it is
  /// used up, the true displacements since the list was built replace it, or the displacements of voxels relative to others near
  /// them. Only if these are used up too is the list built anew.
  /// @return whether it was built anew
  template <class Real>
  bool refresh(const Real* positions, std::size_t stride);

  /// Close pairs, ordered by first, then second voxel, first < second.
  [[nodiscard]] const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs() const { return pairs_; }

  /// Sorts voxels into two kinds by their drive. A pair is then looked at only where the sizes of its kinds allow a contact.
  /// Without this call all voxels are of kind 0. Takes effect when the list is next built.
  /// @param kind per voxel of the lattice, 0 or 1
  void set_kinds(std::vector<std::uint8_t> kind) { kind_ = std::move(kind); }

  /// The pairs in the order in which they are searched, by kinds and distance. order() holds positions in pairs(). first() and
  /// second() hold the voxels of these pairs, followed by as many zeros as a register may read beyond them. place() holds for
  /// each pair in pairs() its position in the order.
  [[nodiscard]] const std::vector<std::int32_t>& order() const { return order_; }
  [[nodiscard]] const std::vector<std::int32_t>& first() const { return first_; }
  [[nodiscard]] const std::vector<std::int32_t>& second() const { return second_; }
  [[nodiscard]] const std::vector<std::int32_t>& place() const { return place_; }

  /// Returns the parts of that order that hold all pairs that may touch now, or whose centres may be closer than touching plus
  /// `further_m`. There is one part for two voxels of kind 0, one for voxels of both kinds, and one for two voxels of kind 1.
  /// @param size_m largest size of the voxels of kind 0 and of kind 1
  [[nodiscard]] std::array<std::pair<std::size_t, std::size_t>, 3> candidates(const std::array<double, 2>& size_m,
                                                                              double further_m = 0.0) const;

  /// Returns the largest sums of two radii (m): for two voxels of kind 0, for voxels of both kinds, and for two voxels of kind 1.
  [[nodiscard]] static std::array<double, 3> reaches_m(const std::array<double, 2>& size_m);

  /// Returns the skin, m; see the constructor.
  [[nodiscard]] double skin_m() const { return skin_m_; }

  /// Whether no allowed pair can touch now. This holds while the gap of the nearest pair was larger than two voxels can have
  /// moved since the list was built. Valid after refresh.
  [[nodiscard]] bool contact_ruled_out() const { return smallest_gap_m_ > 2.0 * bound_m_ + 1e-6 * reach_m_; }  // margin: rounding

 private:
  /// Largest displacement of voxels relative to each other since the list was built, m.
  struct Shift {
    double near_m = 0.0;  ///< of voxels whose grid cells are no more than two apart along any axis
    double far_m = 0.0;   ///< of any voxels
  };
  template <class Real>
  [[nodiscard]] Shift shift(const Real* positions, std::size_t stride);
  template <class Real>
  [[nodiscard]] double true_bound_m(const Real* positions, std::size_t stride);
  void find_pairs();
  void put_in_order();
  [[nodiscard]] double bin_width_m() const { return (reach_m_ + skin_m_) / bins; }

  static constexpr std::size_t bins = 32;  ///< of distance, up to that of the farthest pair in the list

  CollisionRule rule_;
  double reach_m_;
  double skin_m_;
  /// Since the list was built, no two voxels near each other moved relative to each other by more than twice this.
  double bound_m_ = 0.0;
  /// Smallest distance minus reach of an allowed pair when the list was built; at most the skin.
  double smallest_gap_m_ = 0.0;
  bool built_ = false;
  double path_m_ = 0.0;
  std::uint64_t number_ = 0;
  std::vector<double> built_at_;  ///< positions of the surface voxels when the list was built

  double cell_width_m_ = 0.0;                 ///< of the grid, at least reach + skin
  std::array<std::size_t, 3> cells_{};        ///< of the grid along each axis
  std::vector<std::size_t> cell_of_;          ///< per surface voxel
  std::array<std::vector<double>, 6> moves_;  ///< per cell: largest displacements along and against each axis, see shift
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
  std::vector<double> distance_;    ///< per pair, when the list was made
  std::vector<std::uint8_t> kind_;  ///< per voxel; empty: all of kind 0
  std::vector<std::int32_t> order_, first_, second_, place_;
  std::vector<std::size_t> bin_begin_;  ///< in the order, per kinds and bin
};

/// Adds the contact forces of pairs whose spheres overlap, one pair after the other: -f on the first and +f on the second voxel,
/// see contact_force.
/// @param touching positions in `pairs`
/// @param sphere (voxel) -> its x, y, z and size
/// @param end (voxel) -> its ContactEnd
/// @param add (voxel, force on it), adds the force
template <class Real, class Sphere, class End, class Add>
void add_contact_loads(std::span<const std::int32_t> touching, const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs,
                       const Sphere& sphere, const End& end, const Add& add) {
  for (const std::int32_t position : touching) {
    const auto& [first, second] = pairs[static_cast<std::size_t>(position)];
    const std::array<Real, 4> from = sphere(first);
    const std::array<Real, 4> to = sphere(second);
    const Vector3<Real> apart = {to[slot::x] - from[slot::x], to[slot::y] - from[slot::y], to[slot::z] - from[slot::z]};
    const Real reach = static_cast<Real>(collision_radius_fraction) * (from[slot::size] + to[slot::size]);
    const Vector3<Real> force = contact_force(apart, dot(apart, apart), reach, end(first), end(second));
    add(first, -force);
    add(second, force);
  }
}

/// Adds the contact forces of touching pairs to the loads of a body in lines, see add_contact_loads.
template <class Real>
void add_collision_loads(std::span<const std::int32_t> touching, const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs,
                         const StepData<Real>& d);

}  // namespace menger::voxel
