#pragma once

#include <optional>
#include <vector>

#include "meshes/design/polycube.h"
#include "meshes/design/side.h"

namespace menger::meshes {

/// How a body is divided into air spaces.
enum class ChamberLayout {
  single,    ///< all cells of a module form one chamber
  per_phase  ///< every face-connected region of equal material is a chamber
};

/// Which wall of every module is cast as a lid of its own.
enum class LidPlace { none, bottom, top };

/// A square hole through the outer wall, where the supply tube enters. A chamber's volume and pressure end at an imagined lid,
/// flush with the outside.
struct TubeHole {
  CellIndex cell;           ///< of the whole body, that is of the fractal of the stated level
  Side side = Side::z_max;  ///< side of the cell on which the hole opens; no cell may lie behind it
  double edge_m = 0.0;      ///< edge of the square, centred on the side; > 0 and at most cell edge - 2 wall thicknesses

  bool operator==(const TubeHole&) const = default;
};

/// How a design becomes a hollow body of silicone and how finely that is meshed.
///
/// The body of level L is the fractal of the design: level 1 is one module, and every cell of level L - 1 becomes a module, a
/// copy of the design. Each module is hollow with walls of its own; where modules touch face to face they are bonded, so that the
/// joint is two walls thick.
struct HollowBodyOptions {
  double wall_thickness_m = 0.002;          ///< of every outer wall and, in the middle, between two chambers; < half a cell edge
  int elements_through_wall = 1;            ///< at least this many, of equal size, through every wall
  std::optional<double> largest_element_m;  ///< edge that elements may grow to away from walls; none: no larger than in the wall
  double growth = 1.5;                      ///< largest ratio of neighbouring edges while they grow; >= 1
  ChamberLayout chambers = ChamberLayout::single;
  int level = 1;                      ///< of the fractal, >= 1
  std::optional<double> hole_edge_m;  ///< edge of the square holes that join chambers of modules side by side; none: no holes
  std::vector<TubeHole> tubes;
  LidPlace lid = LidPlace::none;  ///< the bottom or top wall of every module becomes region "lid"
  bool joint_region = false;      ///< walls bonded to a neighbouring module become region "joint"

  bool operator==(const HollowBodyOptions&) const = default;
};

}  // namespace menger::meshes
