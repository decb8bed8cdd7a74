#pragma once

#include <cstddef>
#include <vector>

#include "meshes/design/modular_body.h"

namespace menger::meshes {

/// A hole through the joint of two modules, in the middle of the side that two cells share.
struct JointHole {
  CellIndex cell;  ///< cell on the lower side of the joint along its axis
  Side side;       ///< x_max or y_max
};

/// Returns one hole for each two chambers of adjacent modules (along x or y) that touch. The hole goes through the pair of cells
/// nearest to the middle of the contact; if two are equally near, through the first in grid order. Chambers per phase are joined
/// only if their materials are equal.
std::vector<JointHole> joint_holes(const ModularBody& body, ChamberLayout layout);

/// Returns the number of the plenum of each chamber. Chambers joined by holes share one. Plenums are numbered in the order of
/// their first chambers.
std::vector<std::size_t> plenums(const ModularBody& body, const std::vector<JointHole>& holes);

}  // namespace menger::meshes
