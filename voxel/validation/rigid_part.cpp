#include "voxel/validation/rigid_part.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>

namespace menger::voxel {

namespace {

/// Positions, one per column.
using Points = Eigen::Matrix3Xd;

Eigen::Isometry3d best_fit(const Points& rest, const Points& deformed) {
  return Eigen::Isometry3d(Eigen::umeyama(rest, deformed, false));
}

}  // namespace

Eigen::Isometry3d rigid_part(const BodyBoxes& rest, const BodyBoxes& deformed) {
  const auto points_of = [](const BodyBoxes& boxes) {
    Points points(3, static_cast<Eigen::Index>(8 * boxes.corners_m.size()));
    Eigen::Index column = 0;
    for (const auto& corners : boxes.corners_m) {
      for (const BodyBoxes::Point& corner : corners) points.col(column++) = Eigen::Vector3d(corner.data());
    }
    return points;
  };
  return best_fit(points_of(rest), points_of(deformed));
}

Eigen::Isometry3d rigid_part(vtkPolyData& deformed) {
  vtkDataArray& displacements_m = *deformed.GetPointData()->GetArray("displacement_m");
  Points points(3, deformed.GetNumberOfPoints());
  Points rest = points;
  for (vtkIdType n = 0; n < deformed.GetNumberOfPoints(); ++n) {
    deformed.GetPoint(n, points.col(n).data());
    Eigen::Vector3d displacement_m;
    displacements_m.GetTuple(n, displacement_m.data());
    rest.col(n) = points.col(n) - displacement_m;
  }
  return best_fit(rest, points);
}

}  // namespace menger::voxel
