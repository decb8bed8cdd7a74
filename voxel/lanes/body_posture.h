#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "meshes/load_cases/body_extents.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {

/// How a body of voxels stands, by its six ends: see meshes::rotation_of_body. An end is the mean of the outer faces of the
/// voxels that lie outermost along an axis at rest. Each face turns with its voxel.
class BodyPosture {
 public:
  /// @param at_rest before its first step
  /// @param voxel_edge_m > 0
  BodyPosture(const Simulation& at_rest, double voxel_edge_m);

  /// Returns the body's own upright axis now: the direction into which the rotation of the body turns the vertical. Its length is
  /// 1; not a number if the state is none. @param body the same one
  [[nodiscard]] std::array<double, 3> upright_axis(const Simulation& body) const;

 private:
  [[nodiscard]] meshes::EndPoints ends_m(const Simulation& body) const;

  double half_edge_m_;
  std::array<std::array<std::vector<std::size_t>, 2>, 3> voxels_;  ///< of the ends: [axis][low, high]
  meshes::EndPoints at_rest_m_{};
};

}  // namespace menger::voxel
