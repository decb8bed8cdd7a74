#pragma once

#include <cstddef>
#include <vector>

#include "meshes/design/modular_body.h"
#include "meshes/hexahedra/grid_mesh.h"
#include "meshes/hexahedra/hexahedral_mesh.h"
#include "meshes/hexahedra/joint_holes.h"

namespace menger::meshes {

/// A straight square opening from a chamber through one wall: a tube hole, or one half of a hole through a joint.
struct Channel {
  std::size_t chamber;
  std::size_t label;  ///< boundary label of its sides
  Side side;          ///< side on which it leaves the chamber
  GridIndex begin;    ///< first grid cell along each axis
  GridIndex end;      ///< last grid cell along each axis, plus one
};

/// Returns the channels of a body on its grid. Each hole through a joint gives two, with the label of the chamber; then follows
/// one for each tube hole.
/// @param chamber_labels boundary label of each chamber
/// @param tube_labels boundary label of each tube
std::vector<Channel> channels(const std::array<GridLines, 3>& lines, const ModularBody& body, double cell_edge_m,
                              const HollowBodyOptions& options, const std::vector<JointHole>& holes,
                              const std::vector<std::size_t>& chamber_labels, const std::vector<std::size_t>& tube_labels);

/// Returns the cap that closes the outer end of a channel. The two halves of a hole through a joint get the same rim in opposite
/// directions, so that the forces on their caps cancel.
Cap cap_of(const Channel& channel, const HexahedralMesh& mesh, const MeshGrid& grid, const GridElements& element_of_cell);

}  // namespace menger::meshes
