#pragma once

#include <span>
#include <string>
#include <vector>

#include "fem/inflation/inflation_study.h"
#include "fem/space/space.h"
#include "fem/statics/nodal_fields.h"

namespace menger::fem {

/// The location of a named point in the elements: the same material point on every mesh of a body.
struct LocatedPoint {
  NamedPoint point;
  int rank = 0;                 ///< rank whose element contains the point
  std::vector<Index> nodes;     ///< of that element, local; empty on other ranks
  std::vector<double> weights;  ///< values of their shape functions at the point
  std::size_t region = 0;       ///< of the element
};

/// Finds the elements that contain points, by Newton's method on the map of every element whose box is near. Collective; the
/// result is the same on all ranks, except for nodes and weights.
/// @throws io::InputError on all ranks, naming the point, if it lies in no element
std::vector<LocatedPoint> locate_points(const Space& space, const std::vector<NamedPoint>& points);

/// The observed quantities of a point.
struct PointObservation {
  Point displacement_m{};
  /// Largest principal stretch of the nodal deformation gradients (see NodalFields) at the point.
  double largest_stretch = 1.0;

  bool operator==(const PointObservation&) const = default;
};

/// Returns the observations of points in a state. Collective; the same on all ranks.
/// @param displacements 3 per local node, ghosts up to date
std::vector<PointObservation> observe(const Space& space, const std::vector<LocatedPoint>& points,
                                      std::span<const double> displacements, const NodalFields& fields);

}  // namespace menger::fem
