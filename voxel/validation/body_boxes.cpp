#include "voxel/validation/body_boxes.h"

#include <cmath>

#include "voxel/statics/body_shape.h"

namespace menger::voxel {

namespace {

using meshes::Side;

/// Vectors from the centre of a voxel to its low and high side along each axis.
using Arms = std::array<std::array<Vector3<double>, 2>, 3>;

Arms arms_of(const BodyShape& shape, std::size_t voxel, const Vector3<double>& centre) {
  constexpr std::array<std::array<Side, 2>, 3> sides{
      {{Side::x_min, Side::x_max}, {Side::y_min, Side::y_max}, {Side::z_min, Side::z_max}}};
  Arms arms{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t end = 0; end < 2; ++end) arms.at(axis).at(end) = shape.face(voxel, sides.at(axis).at(end)) - centre;
  }
  return arms;
}

/// For each corner of VTK_HEXAHEDRON: low (0) or high (1) end along x, y and z.
constexpr std::array<std::array<std::size_t, 3>, 8> corner_ends{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

/// Volume of the box between arms. The two arms of an axis lie on one line, along an axis of the rotated voxel.
double volume_of(const Arms& arms) {
  double volume = 1.0;
  for (const auto& [low, high] : arms) {
    const Vector3<double> span = high - low;
    volume *= std::sqrt(span.x * span.x + span.y * span.y + span.z * span.z);
  }
  return volume;
}

}  // namespace

BodyBoxes body_boxes(const Equilibrium& equilibrium) {
  const StaticBody& body = equilibrium.balance().body();
  const BodyShape shape(equilibrium);
  const double volume_at_rest = std::pow(body.edge_m, 3);
  BodyBoxes boxes;
  for (std::size_t voxel = 0; voxel < body.voxel_count(); ++voxel) {
    const Vector3<double> centre = equilibrium.pose(voxel).position;
    const Arms arms = arms_of(shape, voxel, centre);
    std::array<BodyBoxes::Point, 8> corners{};
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      const auto& [x, y, z] = corner_ends.at(corner);
      const Vector3<double> at = centre + arms[0].at(x) + arms[1].at(y) + arms[2].at(z);
      corners.at(corner) = {at.x, at.y, at.z};
    }
    boxes.corners_m.push_back(corners);
    boxes.volume_ratio.push_back(volume_of(arms) / volume_at_rest);
  }
  for (const meshes::CellIndex& cell : body.voxels.body.occupied()) boxes.material.push_back(body.voxels.body.at(cell));
  return boxes;
}

BodyBoxes moved(BodyBoxes boxes, const Eigen::Isometry3d& motion) {
  for (auto& corners : boxes.corners_m) {
    for (BodyBoxes::Point& corner : corners) Eigen::Map<Eigen::Vector3d>(corner.data()) = motion * Eigen::Vector3d(corner.data());
  }
  return boxes;
}

}  // namespace menger::voxel
