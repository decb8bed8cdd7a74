#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "meshes/load_cases/body_extents.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {

/// Where a voxel is.
struct VoxelPose {
  std::array<double, 3> position_m{};
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};  ///< unit quaternion (w, x, y, z), body to world
};

/// Returns where the voxels of a simulation are now.
std::vector<VoxelPose> poses_of(const Simulation& simulation);

/// How a body of voxels stands, by its six ends: see meshes::rotation_of_body. An end is the mean of the outer faces of the
/// voxels that lie outermost along an axis at rest. Each face turns with its voxel, so that a body of one layer has ends, too.
class BodyPosture {
 public:
  /// @param at_rest of all voxels, with orientations of no turn; one at least
  /// @param voxel_edge_m > 0
  BodyPosture(std::span<const VoxelPose> at_rest, double voxel_edge_m);

  /// Returns the body's own upright axis: the direction into which the rotation of the body turns the vertical. Its length is 1;
  /// not a number if a pose is none. @param now of the same voxels
  [[nodiscard]] std::array<double, 3> upright_axis(std::span<const VoxelPose> now) const;

 private:
  [[nodiscard]] meshes::EndPoints ends_m(std::span<const VoxelPose> poses) const;

  double half_edge_m_;
  std::array<std::array<std::vector<std::size_t>, 2>, 3> voxels_;  ///< of the ends: [axis][low, high]
  meshes::EndPoints at_rest_m_{};
};

}  // namespace menger::voxel
