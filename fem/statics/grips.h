#pragma once

#include <span>
#include <utility>
#include <vector>

#include "fem/space/node_exchange.h"
#include "fem/space/space.h"
#include "fem/statics/body.h"

namespace menger::fem {

/// Where a plate is: it turns about its centre by a rotation vector and shifts.
struct PlateMotion {
  Point displacement_m{};  ///< of its centre
  Point rotation_rad{};    ///< axis times angle, right-handed

  bool operator==(const PlateMotion&) const = default;
};

/// How a plate moves along a path: its motion at every knot, displacement and rotation vector linear between them. At the first
/// knot it is at rest.
struct PlateDrive {
  std::vector<PlateMotion> values;  ///< one per knot of the path
  /// > 0: beside its displacement the centre follows the end of a bar of this length along x that bends into a circular arc as
  /// the plate turns by a about +y: x = l sin(a) / a - l, z = -l (1 - cos(a)) / a
  double arc_length_m = 0.0;
};

/// The motion at a path parameter, that of the last knot beyond it. At rest without knots.
PlateMotion motion_at(const PlateDrive& drive, double s);

/// Where a plate carries a point of the reference configuration: d + R (X - C) + C - X with R = exp of the rotation vector.
Point plate_displacement(const Plate& plate, const PlateMotion& motion, const Point& position);

/// Force and moment, about the present position of its centre, of a plate on the body.
struct PlateReaction {
  Point force_N{};
  Point moment_N_m{};

  bool operator==(const PlateReaction&) const = default;
};

/// Whether a face belongs to a set.
bool contains(const FaceSet& set, const Space& space, const SpaceFace& face);

/// The owned nodes on the faces of a set, whichever rank's elements have them. Collective.
std::vector<Index> owned_nodes_of(const FaceSet& set, const Space& space, const NodeExchange& exchange);

/// The mean over the reference area of some faces as a sum over nodes.
class FaceMean {
 public:
  FaceMean(const FaceSet& set, const Space& space);

  [[nodiscard]] double area_m2() const { return area_m2_; }  ///< of the faces of all ranks; 0 if there are none
  /// Mean displacement of the faces (area > 0, asserts). Collective. @param displacements 3 per local node, ghosts up to date
  [[nodiscard]] Point displacement_m(std::span<const double> displacements) const;
  /// Mean position of the faces in the reference configuration.
  [[nodiscard]] Point position_m() const;

 private:
  const Space& space_;
  std::vector<std::pair<Index, double>> weights_;  ///< integral of shape functions, of this rank's faces
  double area_m2_ = 0.0;
};

}  // namespace menger::fem
