#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "meshes/design/polycube.h"
#include "voxel/statics/equilibrium.h"

namespace menger::voxel {

/// A surrogate body in equilibrium as boxes for pictures, one per voxel. They show the shape on which extents and volumes are
/// measured (BodyShape).
struct BodyBoxes {
  using Point = std::array<double, 3>;

  /// Corners by voxel, in the order of VTK_HEXAHEDRON, m, from the corner of the body's first cell. Walls are drawn at their mean
  /// bulge, so neighbouring boxes may not meet at their edges.
  std::vector<std::array<Point, 8>> corners_m;
  std::vector<meshes::Material> material;
  std::vector<double> volume_ratio;  ///< of the box, over the volume of the voxel at rest
};

BodyBoxes body_boxes(const Equilibrium& equilibrium);

/// Moves boxes by a rigid motion.
BodyBoxes moved(BodyBoxes boxes, const Eigen::Isometry3d& motion);

}  // namespace menger::voxel
