#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "meshes/design/modular_body.h"
#include "meshes/hexahedra/joint_holes.h"

namespace menger::meshes {

/// Positions of the grid lines along one axis, in metres, increasing.
using GridLines = std::vector<double>;

/// Cuts a span into the fewest edges that begin at both ends with at most `first`, grow inwards by at most the factor `growth`
/// and stay at most `largest`; symmetric. Both lengths > 0, growth >= 1; where largest <= first or growth is 1, the edges are
/// equal.
/// @return the lengths, whose sum is `span`
std::vector<double> graded_edges(double span, double first, double growth, double largest);

/// The grid lines along the three axes in which every wall, chamber and hole of a body is a union of grid cells.
///
/// A plane of cell sides gets lines only on the sides where a wall lies against it: at distances t (outer walls), t / 2 (walls
/// between regions) and 0. Between them lie as many elements as options ask for through the wall, in proportion; the spans
/// between walls are graded. Holes add lines at their sides.
std::array<GridLines, 3> grid_lines(const ModularBody& body, double cell_edge_m, const HollowBodyOptions& options,
                                    const std::vector<JointHole>& holes);

}  // namespace menger::meshes
