#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "meshes/design/polycube.h"
#include "voxel/statics/equilibrium.h"

namespace menger::voxel {

/// A body of the surrogate as boxes, one per voxel, for pictures: what extents and volumes are measured on (see BodyShape).
struct BodyBoxes {
  using Point = std::array<double, 3>;

  /// By voxel, in the order of VTK_HEXAHEDRON, m. Walls stand at their mean bulge, so that neighbouring boxes need not meet at
  /// their edges.
  std::vector<std::array<Point, 8>> corners_m;
  std::vector<meshes::Material> material;
  std::vector<double> volume_change;  ///< of the box, by the voxel's volume at rest
};

BodyBoxes body_boxes(const Equilibrium& equilibrium);

/// The same boxes elsewhere, turned or not.
BodyBoxes moved(BodyBoxes boxes, const Eigen::Isometry3d& motion);

}  // namespace menger::voxel
