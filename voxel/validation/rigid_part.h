#pragma once

#include <vtkPolyData.h>

#include <Eigen/Geometry>

#include "voxel/validation/body_boxes.h"

namespace menger::voxel {

/// The rigid motion nearest to a deformation. It minimises the sum of squared distances between the moved corners of the boxes at
/// rest and the corners of the deformed boxes. @param deformed as many boxes, in the same order
Eigen::Isometry3d rigid_part(const BodyBoxes& rest, const BodyBoxes& deformed);

/// The rigid motion nearest to the deformation of a surface. Its points are already displaced by its point data displacement_m.
Eigen::Isometry3d rigid_part(vtkPolyData& deformed);

}  // namespace menger::voxel
