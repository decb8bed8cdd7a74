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

/// Which pairs of voxels of a lattice may collide: surface voxels farther apart than `exclusion_depth` beams (or not joined at
/// all).
class CollisionRule {
 public:
  /// @param exclusion_depth >= 1
  CollisionRule(const Lattice& lattice, int exclusion_depth);

  [[nodiscard]] const std::vector<std::int32_t>& surface() const { return surface_; }

  /// Whether no pair of surface voxels may collide, so that collisions can be left out of the scene.
  [[nodiscard]] bool excludes_every_pair() const { return excludes_every_pair_; }

  /// Of `candidates` (voxels above `voxel`), those that may collide with `voxel`; order kept.
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

/// Verlet list: all pairs that may collide and are closer than reach + skin, found on a uniform grid and kept until the
/// displacements since then could have brought another pair into reach. A part of a body may go anywhere with all that is near
/// it.
class VerletList {
 public:
  /// @param reach_m largest distance of the centres at which two voxels can overlap; @param skin_m > 0
  VerletList(CollisionRule rule, double reach_m, double skin_m);

  /// Builds the list from positions (x, y, z of voxel i at positions[stride * i + 0, 1, 2]).
  template <class Real>
  void build(const Real* positions, std::size_t stride);

  /// Tells the list how far a voxel may have moved in a step, at most. It is made anew when these displacements add up.
  void moved(double displacement_m) {
    bound_m_ += displacement_m;
    way_m_ += displacement_m;
  }

  /// The sum of the displacements that it was told.
  [[nodiscard]] double way_m() const { return way_m_; }

  /// How often the list was made.
  [[nodiscard]] std::uint64_t number() const { return number_; }

  /// Whether refresh would look at positions.
  [[nodiscard]] bool bound_used_up() const { return !built_ || bound_m_ > 0.5 * skin_m_; }

  /// Makes the list valid for these positions. The sum of the largest displacements of each step is a cheap bound; when it is
  /// used up, the true displacements since the list was made replace it, or those of voxels against others near them, and only if
  /// these are used up too is the list made anew. Returns whether it was.
  template <class Real>
  bool refresh(const Real* positions, std::size_t stride);

  /// Close pairs, ordered by first, then second voxel, first < second.
  [[nodiscard]] const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs() const { return pairs_; }

  /// Tells voxels of two kinds of drive apart, so that a pair is looked at only where the sizes of its kinds allow a contact; all
  /// are of kind 0 before. Takes effect when the list is made. @param kind per voxel of the lattice, 0 or 1
  void set_kinds(std::vector<std::uint8_t> kind) { kind_ = std::move(kind); }

  /// The pairs in the order in which they are looked at, by kinds and distance: positions in pairs(), and their voxels, followed
  /// by as many zeros as a register may read beyond them; place() is where a pair stands in that order.
  [[nodiscard]] const std::vector<std::int32_t>& order() const { return order_; }
  [[nodiscard]] const std::vector<std::int32_t>& first() const { return first_; }
  [[nodiscard]] const std::vector<std::int32_t>& second() const { return second_; }
  [[nodiscard]] const std::vector<std::int32_t>& place() const { return place_; }

  /// Parts of that order that hold all pairs that may touch now, or whose centres may be closer than that and `further_m`: for
  /// both voxels of kind 0, of either, and of kind 1. @param size_m of the voxels of kind 0 and of kind 1, at most
  [[nodiscard]] std::array<std::pair<std::size_t, std::size_t>, 3> candidates(const std::array<double, 2>& size_m,
                                                                              double further_m = 0.0) const;

  /// Sums of the radii (m) at most, for both voxels of kind 0, of either, and of kind 1.
  [[nodiscard]] static std::array<double, 3> reaches_m(const std::array<double, 2>& size_m);

  /// Of the list, see the constructor.
  [[nodiscard]] double skin_m() const { return skin_m_; }

  /// Whether no allowed pair can touch now: the nearest one was farther apart than two voxels can have moved since the list was
  /// made. Valid after refresh.
  [[nodiscard]] bool contact_ruled_out() const { return smallest_gap_m_ > 2.0 * bound_m_ + 1e-6 * reach_m_; }  // margin: rounding

 private:
  /// How far voxels have moved against each other since the list was made, at most, m.
  struct Shift {
    double near_m = 0.0;  ///< those whose cells of the grid are no more than two apart along any axis
    double far_m = 0.0;   ///< any
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
  double bound_m_ =
      0.0;  ///< since the list was made, no two voxels near each other moved against each other by more than twice this
  double smallest_gap_m_ =
      0.0;  ///< smallest distance minus reach of an allowed pair when the list was made; the skin where that is larger
  bool built_ = false;
  double way_m_ = 0.0;
  std::uint64_t number_ = 0;
  std::vector<double> built_at_;  ///< positions of the surface voxels then

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

/// Finds the contact forces of pairs whose spheres overlap, one after the other: -f on the first, +f on the second voxel, see
/// contact_force.
/// @param touching positions in `pairs` @param sphere gives x, y, z and size of a voxel @param end its ContactEnd @param add
/// takes a voxel and the force on it
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

/// The same for a body in lines, whose loads they are added to.
template <class Real>
void add_collision_loads(std::span<const std::int32_t> touching, const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs,
                         const StepData<Real>& d);

}  // namespace menger::voxel
