#pragma once

#include <span>
#include <utility>
#include <vector>

#include "fem/space/node_exchange.h"
#include "fem/space/space.h"
#include "fem/statics/body.h"

namespace menger::fem {

/// The motion of a plate since the reference configuration: a rotation about its centre and a displacement.
struct PlateMotion {
  Point displacement_m{};  ///< of its centre
  Point rotation_rad{};    ///< rotation vector: axis times angle, right-handed

  bool operator==(const PlateMotion&) const = default;
};

/// The motion of a plate along a path, at every knot. Displacement and rotation vector are linear between knots. At the first
/// knot the plate is at rest.
struct PlateDrive {
  std::vector<PlateMotion> values;  ///< one per knot of the path
  /// > 0: in addition to its displacement, the centre follows the end of a bar of this length along x that bends into a circular
  /// arc as the plate rotates by a about +y: x = l sin(a) / a - l, z = -l (1 - cos(a)) / a
  double arc_length_m = 0.0;
};

/// Returns the motion of a plate at a path parameter. Beyond the last knot it is that of the last knot; without knots the plate
/// is at rest.
PlateMotion motion_at(const PlateDrive& drive, double s);

/// Returns the displacement of a point that a plate carries: d + R (X - C) + C - X, with the point X in the reference
/// configuration and R = exp of the rotation vector.
Point plate_displacement(const Plate& plate, const PlateMotion& motion, const Point& position);

/// Force and moment of a plate on the body. The moment is about the present position of the plate's centre.
struct PlateReaction {
  Point force_N{};
  Point moment_N_m{};

  bool operator==(const PlateReaction&) const = default;
};

/// Whether a face belongs to a set.
bool contains(const FaceSet& set, const Space& space, const SpaceFace& face);

/// Returns the owned nodes on the faces of a set, also where the faces belong to elements of other ranks. Collective.
std::vector<Index> owned_nodes_of(const FaceSet& set, const Space& space, const NodeExchange& exchange);

/// The mean over the reference area of a set of faces, stored as weights of nodes.
class FaceMean {
 public:
  FaceMean(const FaceSet& set, const Space& space);

  [[nodiscard]] double area_m2() const { return area_m2_; }  ///< of the faces of all ranks; 0 if there are none
  /// Returns the mean displacement of the faces (area > 0, asserts). Collective. @param displacements 3 per local node, ghosts up
  /// to date
  [[nodiscard]] Point displacement_m(std::span<const double> displacements) const;
  /// Returns the mean position of the faces in the reference configuration.
  [[nodiscard]] Point position_m() const;

 private:
  const Space& space_;
  std::vector<std::pair<Index, double>> weights_;  ///< integral of shape functions, of this rank's faces
  double area_m2_ = 0.0;
};

}  // namespace menger::fem
