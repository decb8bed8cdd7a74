#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "fem/space/space.h"
#include "fem/statics/body.h"
#include "fem/statics/element_results.h"
#include "fem/thin_walls/thin_wall_stiffness.h"

namespace menger::fem {

/// The edges of an element of the space that is a box along the axes.
std::array<double, 3> box_edges_m(const Space& space, std::size_t element);

/// The displacements of the corners of an element. @param displacements_m 3 per local node
BoxNumbers corner_displacements(const Space& space, std::size_t element, std::span<const double> displacements_m);

/// The walls and blocks of a rank, in batches of one material, kind and normal; see ElementGroups.
class ThinWallGroups {
 public:
  ThinWallGroups(const Space& space, const Body& body);

  /// See ElementGroups::evaluate. The smallest ratio is that of ThinWallOutcome, -1 where an element counts as inverted.
  ElementSums evaluate(std::span<const double> displacements_m, const ElementWanted& wanted, const ElementReceiver& receive);

  /// See ElementGroups::evaluate_points. Of the eight points of an element, four across a wall share one value, as they do in its
  /// energy: the in-plane part of F at +-1/sqrt(3) of half the thickness. All points of a block have the value of its centre.
  /// Stress is that of the element under this F, minus the mean of the pressures on the faces of a wall.
  void evaluate_points(std::span<const double> displacements_m, std::span<const double> plenum_pressures_Pa,
                       const PointReceiver& receive);

 private:
  struct Batch {
    std::size_t region = 0;
    ThinWallBatch shape;
    std::vector<std::size_t> elements;  ///< local
  };
  void place(const Batch& batch, std::span<const double> displacements_m);

  const Space& space_;
  const Body& body_;
  ThinWallStiffness kernel_;
  std::vector<ThinWallMaterial> materials_;
  std::vector<Batch> batches_;
  std::vector<double> corners_m_;
};

}  // namespace menger::fem
