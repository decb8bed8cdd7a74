#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace menger::meshes {

/// Where the height of a body's top is measured.
struct BodyTop {
  std::vector<std::size_t> cells;           ///< positions of the cells of the top layer whose centres are nearest to the middle
  std::vector<std::array<int, 2>> towards;  ///< from the centre of each cell to its point, along x and y, in half edges: -1, 0, 1
  std::vector<std::array<double, 3>> points;  ///< in cells from the corner of the grid; the height is their mean
  bool is_open = false;                       ///< whether no cell of the top layer reaches its middle
};

/// Returns where the height of a body's top is measured. If a cell of the top layer reaches the middle of the body, seen from
/// above, this is one point, the middle. Otherwise these are points of the cells whose centres are nearest to the middle: of each
/// cell, the one nearest to the middle. A ring of 3 x 3 cells has four, an L two. Unlike corners of a mesh they stay where they
/// are when the mesh is refined.
/// @param cells x, y and z of each cell, at least one
[[nodiscard]] BodyTop top_of(const std::vector<std::array<int, 3>>& cells);

}  // namespace menger::meshes
