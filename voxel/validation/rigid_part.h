#pragma once

#include <vtkPolyData.h>

#include <Eigen/Geometry>

#include "voxel/validation/body_boxes.h"

namespace menger::voxel {

/// The rigid motion that comes nearest to a deformation: the least sum of squared distances between the moved corners of the
/// boxes at rest and the deformed ones. @param deformed as many boxes in the same order
Eigen::Isometry3d rigid_part(const BodyBoxes& rest, const BodyBoxes& deformed);

/// The same for the points of a surface, which are where its point data displacement_m brought them.
Eigen::Isometry3d rigid_part(vtkPolyData& deformed);

}  // namespace menger::voxel
