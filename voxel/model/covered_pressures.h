#pragma once

#include <string>

#include "meshes/design/polycube.h"
#include "meshes/load_cases/load_case.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// The walls of a body, as far as they decide at which pressures its parameters were fitted. They are the walls of its cells, not
/// of its voxels, so that cells of several voxels are compared by the same spans.
struct BodyWalls {
  /// Whether the body has a cell in such a gap and of such a class: by the number of cells between the two walls that the cell
  /// lies between along an axis, then by its wall class along that axis.
  ByGap<ByWallClass<bool>> facing{};
  /// The same for cells whose faces are as wide as their wall class says. Where an arm leaves a body, the class says more: an arm
  /// opens a side, and hardly widens the wall.
  ByGap<ByWallClass<bool>> as_wide{};
  bool has_joints = false;  ///< modules or chambers bonded to each other
};

/// Returns the walls of the fractal of a basal body. All modules have the same walls. At level 2 and above the modules are
/// bonded.
BodyWalls body_walls(const meshes::Polycube& basal_body, int level, meshes::ChamberLayout chambers);
BodyWalls body_walls(const meshes::LoadCase& load_case);

/// Returns every wall that a body may have.
/// @param has_joints whether the body may consist of several modules or chambers
BodyWalls all_walls(bool has_joints);

/// The pressures that are covered for a body with given walls, 0 among them. The texts name what ends the range on each side:
/// "voxels with a wall on one side (wall class 1)", "joints".
struct CoveredPressures {
  double lowest_Pa = 0.0;
  double highest_Pa = 0.0;
  std::string lowest_by;
  std::string highest_by;

  /// Whether a pressure is covered, up to rounding.
  [[nodiscard]] bool contains(double pressure_Pa) const;
};

/// Returns the pressures that are covered for all walls of a body: the intersection of the ranges that ValidityRange holds for
/// them.
CoveredPressures covered_pressures(const ValidityRange& validity, const BodyWalls& walls);

/// Widens the range of validity to the pressures that a load case reached on a body. It is widened for all classes of walls of
/// the body that are as wide as their class says, and for joints if the body has any. Zero stays inside. What a class bore under
/// vacuum is also covered where the facing walls are further apart, because there they can move further before they meet.
void cover(ValidityRange& validity, const BodyWalls& walls, double lowest_Pa, double highest_Pa);

}  // namespace menger::voxel
