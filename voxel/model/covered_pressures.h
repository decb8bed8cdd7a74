#pragma once

#include <string>

#include "meshes/design/polycube.h"
#include "meshes/load_cases/load_case.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// The walls of a body as far as they decide which pressures its parameters were fitted at: of its cells, not of its voxels, so
/// that cells of several voxels are judged by the same spans.
struct BodyWalls {
  /// By cells between the two walls that a cell lies between along an axis, and its class along it.
  ByGap<ByWallClass<bool>> facing{};
  bool has_joints = false;  ///< modules or chambers bonded to each other
};

/// The walls of the fractal of a basal body. All modules have the same; at level 2 and above they are bonded.
BodyWalls body_walls(const meshes::Polycube& basal_body, int level, meshes::ChamberLayout chambers);
BodyWalls body_walls(const meshes::LoadCase& load_case);

/// Every wall that a body may have. @param has_joints whether it may consist of several modules or chambers
BodyWalls all_walls(bool has_joints);

/// Pressures that a body with some walls is covered at, 0 among them, and what ends them: "wall class 2a", "joints".
struct CoveredPressures {
  double lowest_Pa = 0.0;
  double highest_Pa = 0.0;
  std::string lowest_by;
  std::string highest_by;

  /// But for rounding.
  [[nodiscard]] bool contains(double pressure_Pa) const;
};

/// The pressures that are covered for all walls of a body: of each the range in ValidityRange, intersected.
CoveredPressures covered_pressures(const ValidityRange& validity, const BodyWalls& walls);

/// Widens the range of all walls of a body to pressures that a load case reached with it; zero is always inside. Vacuum that
/// walls of a class bear across a gap is covered across wider ones, too, where they have further to go until they meet.
void cover(ValidityRange& validity, const BodyWalls& walls, double lowest_Pa, double highest_Pa);

}  // namespace menger::voxel
