#pragma once

#include <optional>
#include <vector>

#include "meshes/design/polycube.h"
#include "meshes/design/side.h"

namespace menger::meshes {

/// How a body is divided into chambers.
enum class ChamberLayout {
  single,    ///< all cells of a module form one chamber
  per_phase  ///< every face-connected region of equal material is a chamber
};

/// The wall of every module that is cast apart as a lid.
enum class LidPlace { none, bottom, top };

/// A square hole through the outer wall for the supply tube. The volume and the pressure of the chamber end at an imaginary lid,
/// flush with the outside.
struct TubeHole {
  CellIndex cell;           ///< cell of the whole body, which is the fractal of the given level
  Side side = Side::z_max;  ///< side of the cell on which the hole opens; the cell behind it must be empty
  double edge_m = 0.0;      ///< edge of the square, which is centred on the side; > 0 and at most cell edge - 2 wall thicknesses

  bool operator==(const TubeHole&) const = default;
};

/// How a design becomes a hollow body of silicone, and how finely it is meshed.
///
/// The body of level L is the fractal of the design. Level 1 is one module; every cell of level L - 1 becomes a module, a copy of
/// the design. Each module is hollow and has walls of its own. Modules that touch face to face are bonded there, so the joint is
/// two walls thick.
struct HollowBodyOptions {
  /// Thickness of every outer wall, and of the partition between two chambers; < half a cell edge.
  double wall_thickness_m = 0.002;
  int elements_through_wall = 1;  ///< at least this many elements, of equal size, through every wall
  /// Largest edge of elements away from walls; none: no larger than in the wall.
  std::optional<double> largest_element_m;
  double growth = 1.5;  ///< largest ratio of neighbouring edges where they grow; >= 1
  /// Number of equal elements into which the span between the two walls of a cell is cut; longer spans are cut into elements that
  /// are no larger. Takes the place of largest_element_m and growth. Empty: those decide.
  std::optional<int> elements_per_span{};
  ChamberLayout chambers = ChamberLayout::single;
  int level = 1;                      ///< level of the fractal, >= 1
  std::optional<double> hole_edge_m;  ///< edge of the square holes that join chambers of adjacent modules; none: no holes
  std::vector<TubeHole> tubes;
  LidPlace lid = LidPlace::none;  ///< the bottom or top wall of every module becomes region "lid"
  bool joint_region = false;      ///< walls bonded to a neighbouring module become region "joint"

  bool operator==(const HollowBodyOptions&) const = default;
};

}  // namespace menger::meshes
