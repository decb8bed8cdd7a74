#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// What a chamber of a hollow body is made from.
struct ChamberOrigin {
  std::size_t module = 0;     ///< position of its module among the modules, in grid order
  Material material = empty;  ///< of its cells; that of the first cell where chambers are not per phase
  double volume_m3 = 0.0;     ///< in closed form, its share of holes included (a joint's hole is halved at the joint)
};

/// A hollow body and what is known of it in closed form.
struct HollowBody {
  HexahedralMesh mesh;                  ///< labels "outer", "ground", "chamber 0", ..., "tube"; regions "wall", "lid", "joint"
  std::vector<ChamberOrigin> chambers;  ///< in the order of mesh.chambers
  std::size_t module_count = 1;
  std::size_t hole_count = 0;          ///< holes in joints
  std::size_t edge_contact_count = 0;  ///< places where modules touch only along an edge and are not bonded
  double wall_volume_m3 = 0.0;         ///< of the silicone, in closed form
};

/// A design as a hollow body: its cells minus the chambers, in hexahedra that conform.
///
/// A chamber holds the points of its region (see ChamberLayout) whose distance in the max norm is at least the wall thickness t
/// from where the module ends and at least t / 2 from other regions of the module. The mesh is a tensor product of grid lines, so
/// its volume is that of the body. Boundary labels: "ground" for faces in the lowest plane of the body that look down, "outer"
/// for the other faces outside, the name of the chamber inside, "tube" for the sides of a tube hole ("tube 0", "tube 1", ... if
/// there are several). Positions are those of the cells: cell (i, j, k) begins at (i, j, k) times the cell edge.
///
/// Holes in joints: one, in the middle of a pair of cells, for each two chambers of modules side by side (along x or y) that
/// touch and, per phase, are of equal material; it is the pair nearest to the middle of their contact. The chambers of a hole are
/// one plenum, and a cap divides their air in the plane of the joint.
///
/// Modules that touch only along an edge or at a corner are not bonded there: their points coincide but are not shared.
/// @throws io::InputError naming design and option if a wall is not thinner than half a cell, wall or chamber are thinner than
/// 1/10000 of a cell, elements are shorter than 1/20000 of a cell, a hole is narrower than 1/1000 of a cell or wider than the
/// chamber behind it or does not lie on an outer side, the design or its fractal is not face-connected, cells of the design touch
/// only along an edge or at a corner, or the grid would have more than largest_grid_cell_count cells
HollowBody hollow_polycube(const Design& design, const HollowBodyOptions& options);

/// Grid cells of the tensor product up to which a body is meshed.
inline constexpr std::size_t largest_grid_cell_count = 50'000'000;

/// One cell of edge `edge_m`: a cube with a cubic chamber.
Design hollow_cube_design(double edge_m);

}  // namespace menger::meshes
