#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "meshes/design/modular_body.h"
#include "meshes/hexahedra/joint_holes.h"

namespace menger::meshes {

/// The positions of the grid lines along one axis, in metres, increasing.
using GridLines = std::vector<double>;

/// Divides a span into the fewest equal edges that are at most `largest`; both > 0.
/// @return the lengths, whose sum is `span`
std::vector<double> equal_edges(double span, double largest);

/// Divides a span symmetrically into the fewest edges. Edges at both ends are at most `first`, grow towards the middle by at most
/// the factor `growth`, and are at most `largest`. Both lengths > 0, growth >= 1. If largest <= first or growth is 1, all edges
/// are equal.
/// @return the lengths, whose sum is `span`
std::vector<double> graded_edges(double span, double first, double growth, double largest);

/// Returns the grid lines along the three axes. Every wall, chamber and hole of the body is then a union of grid cells.
///
/// A plane between cells gets lines only on those sides where there is a wall: at distance t (outer walls) and 0. Partitions lie
/// between these lines; where there are no outer walls, they get lines at distance t / 2 on both sides. Walls are divided into
/// elements of equal size, in proportion to their thickness: as many as the options require through a wall. The spans between
/// walls are graded. Holes add lines at their sides.
std::array<GridLines, 3> grid_lines(const ModularBody& body, double cell_edge_m, const HollowBodyOptions& options,
                                    const std::vector<JointHole>& holes);

}  // namespace menger::meshes
