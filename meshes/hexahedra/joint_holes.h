#pragma once

#include <cstddef>
#include <vector>

#include "meshes/design/modular_body.h"

namespace menger::meshes {

/// A hole through the joint of two modules, in the middle of the side that two cells share.
struct JointHole {
  CellIndex cell;  ///< on the lower side of the joint along its axis
  Side side;       ///< x_max or y_max
};

/// One hole for each two chambers of modules side by side (along x or y) that touch, through the pair of cells nearest to the
/// middle of their contact (on a tie the first in grid order). Chambers per phase are joined only if their materials are equal.
std::vector<JointHole> joint_holes(const ModularBody& body, ChamberLayout layout);

/// Number of the plenum of each chamber: chambers that holes join share one; numbered by their first chamber.
std::vector<std::size_t> plenums(const ModularBody& body, const std::vector<JointHole>& holes);

}  // namespace menger::meshes
