#include "voxel/lanes/body_posture.h"

#include <algorithm>
#include <cassert>

namespace menger::voxel {
namespace {

/// An axis of a voxel in the world: a column of the rotation matrix of its unit quaternion (w, x, y, z).
std::array<double, 3> turned_axis(const std::array<double, 4>& orientation, std::size_t axis) {
  const auto [w, x, y, z] = orientation;
  switch (axis) {
    case 0:
      return {1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)};
    case 1:
      return {2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)};
    default:
      return {2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)};
  }
}

}  // namespace

BodyPosture::BodyPosture(const Simulation& at_rest, double voxel_edge_m) : half_edge_m_(0.5 * voxel_edge_m) {
  assert(voxel_edge_m > 0.0 && at_rest.steps() == 0);
  std::vector<std::array<double, 3>> places_m;
  for (std::size_t voxel = 0; voxel < at_rest.voxel_count(); ++voxel) places_m.push_back(at_rest.position_m(voxel));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto along = [axis](const std::array<double, 3>& place) { return place.at(axis); };
    const auto [low, high] = std::ranges::minmax(places_m, {}, along);
    for (std::size_t voxel = 0; voxel < places_m.size(); ++voxel) {
      // voxels of other layers are a whole edge away
      if (along(places_m[voxel]) < along(low) + half_edge_m_) voxels_.at(axis)[0].push_back(voxel);
      if (along(places_m[voxel]) > along(high) - half_edge_m_) voxels_.at(axis)[1].push_back(voxel);
    }
  }
  at_rest_m_ = ends_m(at_rest);
}

meshes::EndPoints BodyPosture::ends_m(const Simulation& body) const {
  meshes::EndPoints ends{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t end = 0; end < 2; ++end) {
      const std::vector<std::size_t>& voxels = voxels_.at(axis).at(end);
      const double outwards_m = end == 0 ? -half_edge_m_ : half_edge_m_;
      for (const std::size_t voxel : voxels) {
        const std::array<double, 3> place_m = body.position_m(voxel);
        const std::array<double, 3> direction = turned_axis(body.orientation(voxel), axis);
        for (std::size_t i = 0; i < 3; ++i)
          ends.at(axis).at(end).at(i) += (place_m.at(i) + outwards_m * direction.at(i)) / static_cast<double>(voxels.size());
      }
    }
  }
  return ends;
}

std::array<double, 3> BodyPosture::upright_axis(const Simulation& body) const {
  const auto rotation = meshes::rotation_of_body(at_rest_m_, ends_m(body));
  return {rotation[0][2], rotation[1][2], rotation[2][2]};
}

}  // namespace menger::voxel
