#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// The origin of a chamber of a hollow body: its module, material and volume.
struct ChamberOrigin {
  std::size_t module = 0;     ///< number of its module in grid order
  Material material = empty;  ///< material of its cells; that of the first cell if chambers are not per phase
  double volume_m3 = 0.0;     ///< in closed form, including its share of holes (a hole through a joint is halved at the joint)
};

/// A hollow body and its properties in closed form.
struct HollowBody {
  HexahedralMesh mesh;                  ///< labels "outer", "ground", "chamber 0", ..., "tube"; regions "wall", "lid", "joint"
  std::vector<ChamberOrigin> chambers;  ///< in the order of mesh.chambers
  std::size_t module_count = 1;
  std::size_t hole_count = 0;          ///< holes through joints
  std::size_t edge_contact_count = 0;  ///< places where modules touch only along an edge and are not bonded
  double wall_volume_m3 = 0.0;         ///< volume of the silicone, in closed form
};

/// Makes the hollow body of a design: its cells minus the chambers, meshed with hexahedra that conform.
///
/// A chamber consists of the points of its region (see ChamberLayout) that are, in the max norm, at least the wall thickness t
/// from the end of the module and at least t / 2 from other regions of the module. Regions end in planes between cells; where
/// outer walls lie in such a plane, other regions end t / 2 beside it (see PartitionPlace). The mesh is a tensor product of grid
/// lines, so its volume is exactly that of the body.
///
/// Boundary labels: "ground" for faces in the lowest plane of the body that face down, "outer" for the other faces outside, the
/// name of the chamber inside, "tube" for the sides of a tube hole ("tube 0", "tube 1", ... if there are several). Cell (i, j, k)
/// begins at (i, j, k) times the cell edge.
///
/// Holes through joints: there is one for each two chambers of adjacent modules (along x or y) that touch; with chambers per
/// phase, only if their materials are equal. It lies in the middle of a pair of cells, the pair nearest to the middle of the
/// contact. The two chambers belong to one plenum. A cap in the plane of the joint divides their air.
///
/// Modules that touch only along an edge or at a corner are not bonded there. Their points coincide but are not shared.
/// @throws io::InputError naming design and option if
/// - a wall is not thinner than half a cell, or a wall or chamber is thinner than 1/10000 of a cell;
/// - elements are shorter than 1/20000 of a cell;
/// - a hole is narrower than 1/1000 of a cell, wider than the chamber behind it, or not on an outer side;
/// - the design or its fractal is not face-connected, or cells of the design touch only along an edge or at a corner;
/// - the grid would have more than largest_grid_cell_count cells.
HollowBody hollow_polycube(const Design& design, const HollowBodyOptions& options);

/// The largest number of grid cells of the tensor product for which a body is meshed.
inline constexpr std::size_t largest_grid_cell_count = 50'000'000;

/// Returns a design of one cell of edge `edge_m`: a cube with a cubic chamber.
Design hollow_cube_design(double edge_m);

}  // namespace menger::meshes
