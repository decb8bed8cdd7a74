#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "meshes/load_cases/body_extents.h"

namespace menger::meshes {

/// Returns the feet that a body stands on: the parts of its lowest layer whose cells touch face to face. Each is a list of
/// positions in `cells`. Feet are in the order of their first cells.
/// @param cells x, y and z of each cell, ascending by z, then y, then x
[[nodiscard]] std::vector<std::vector<std::size_t>> feet_of(const std::vector<std::array<int, 3>>& cells);

/// Returns how far each foot has moved away from the middle of all feet, m; negative towards it. With X_i the places of the feet
/// at rest about their mean, x_i the same deformed, R the rotation of the body, and e_i the horizontal direction of X_i:
///
///     e_i . R^T x_i - e_i . X_i.
///
/// It does not change under a rigid motion. A foot in the middle of all has no direction, and its number is 0.
/// @param at_rest, deformed mean positions of the soles
/// @param ends_at_rest, ends_deformed of the body, from which its rotation follows
[[nodiscard]] std::vector<double> feet_outwards_m(const std::vector<std::array<double, 3>>& at_rest,
                                                  const std::vector<std::array<double, 3>>& deformed,
                                                  const EndPoints& ends_at_rest, const EndPoints& ends_deformed);

}  // namespace menger::meshes
