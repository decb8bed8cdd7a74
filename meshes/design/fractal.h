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

/// Returns the Hausdorff dimension log_m(c) of the fractal of a cubic body with m cells per side and c occupied cells.
/// @throws std::invalid_argument if the grid is not cubic, m < 2 or the body is empty
double hausdorff_dimension(const Polycube& body);

}  // namespace menger::meshes
