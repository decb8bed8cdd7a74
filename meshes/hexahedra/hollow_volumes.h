#pragma once

#include <vector>

#include "meshes/design/modular_body.h"
#include "meshes/hexahedra/joint_holes.h"

namespace menger::meshes {

/// The volumes of a hollow body, counted block by block, exact except for rounding.
struct HollowVolumes {
  double wall_m3 = 0.0;
  std::vector<double> chambers_m3;  ///< per region; including half of each joint hole and the whole of each tube hole
};

/// Computes the volumes by counting the blocks of every cell. Each axis of a cell is cut at the wall thickness t and at t / 2
/// from both sides.
HollowVolumes hollow_volumes(const ModularBody& body, double cell_edge_m, const HollowBodyOptions& options,
                             const std::vector<JointHole>& holes);

}  // namespace menger::meshes
