#pragma once

#include <cstddef>
#include <optional>

#include "meshes/design/polycube.h"

namespace menger::meshes {

/// Returns `aggregate` with every occupied cell replaced by `body`, with the materials of the body. Empty cells become empty
/// blocks.
Polycube replace_cells(const Polycube& aggregate, const Polycube& body);

/// Returns the fractal of a basal body. Level 1 is the body; level n + 1 is level n with every occupied cell replaced by the body
/// (iteration, not recursion).
/// @param level >= 1
/// @throws std::invalid_argument for level < 1
/// @throws std::length_error if the grid would exceed `largest_grid_bytes`
Polycube fractal(const Polycube& body, int level, std::size_t largest_grid_bytes = std::size_t{1} << 30);

/// Returns the body whose fractal of this level an aggregate is; nothing if it is of none.
/// @param level >= 1
std::optional<Polycube> basal_body(const Polycube& aggregate, int level);

/// Returns the body length of an aggregate in metres: the edge of the grid that its copies are put in, whatever part of it the
/// body fills. That is the cells along a side of the module's grid, to the power of the level, times the cell edge.
/// @param cells_per_side of the module; 3 in searches, whose bodies have 3, 9 and 27 cells per side at levels 1, 2 and 3
double body_length_m(int level, double cell_edge_m, int cells_per_side = 3);

/// Returns the Hausdorff dimension log_m(c) of the fractal of a cubic body with m cells per side and c occupied cells.
/// @throws std::invalid_argument if the grid is not cubic, m < 2 or the body is empty
double hausdorff_dimension(const Polycube& body);

}  // namespace menger::meshes
