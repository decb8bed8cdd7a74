#include "voxel/lanes/body_posture.h"

#include <algorithm>
#include <cassert>

#include "voxel/laws/rotation.h"

namespace menger::voxel {

std::vector<VoxelPose> poses_of(const Simulation& simulation) {
  std::vector<VoxelPose> poses;
  poses.reserve(simulation.voxel_count());
  for (std::size_t voxel = 0; voxel < simulation.voxel_count(); ++voxel)
    poses.push_back({simulation.position_m(voxel), simulation.orientation(voxel)});
  return poses;
}

BodyPosture::BodyPosture(std::span<const VoxelPose> at_rest, double voxel_edge_m) : half_edge_m_(0.5 * voxel_edge_m) {
  assert(voxel_edge_m > 0.0 && !at_rest.empty());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto along_m = [axis](const VoxelPose& pose) { return pose.position_m.at(axis); };
    const auto [low, high] = std::ranges::minmax(at_rest, {}, along_m);
    for (std::size_t voxel = 0; voxel < at_rest.size(); ++voxel) {
      // voxels of other layers are a whole edge away
      if (along_m(at_rest[voxel]) < along_m(low) + half_edge_m_) voxels_.at(axis)[0].push_back(voxel);
      if (along_m(at_rest[voxel]) > along_m(high) - half_edge_m_) voxels_.at(axis)[1].push_back(voxel);
    }
  }
  at_rest_m_ = ends_m(at_rest);
}

meshes::EndPoints BodyPosture::ends_m(std::span<const VoxelPose> poses) const {
  meshes::EndPoints ends{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t end = 0; end < 2; ++end) {
      const std::vector<std::size_t>& voxels = voxels_.at(axis).at(end);
      std::array<double, 3> outwards_m{};
      outwards_m.at(axis) = end == 0 ? -half_edge_m_ : half_edge_m_;
      for (const std::size_t voxel : voxels) {
        const auto [w, x, y, z] = poses[voxel].orientation;
        const Vector3<double> face_m =
            rotate(matrix(Quaternion<double>{w, x, y, z}), Vector3<double>{outwards_m[0], outwards_m[1], outwards_m[2]});
        const std::array<double, 3>& centre_m = poses[voxel].position_m;
        const std::array<double, 3> place_m{centre_m[0] + face_m.x, centre_m[1] + face_m.y, centre_m[2] + face_m.z};
        for (std::size_t i = 0; i < 3; ++i) ends.at(axis).at(end).at(i) += place_m.at(i) / static_cast<double>(voxels.size());
      }
    }
  }
  return ends;
}

std::array<double, 3> BodyPosture::upright_axis(std::span<const VoxelPose> now) const {
  const auto rotation = meshes::rotation_of_body(at_rest_m_, ends_m(now));
  return {rotation[0][2], rotation[1][2], rotation[2][2]};
}

}  // namespace menger::voxel
