#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshes/hexahedra/grid_lines.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// The content of a cell of a grid: the region of a solid, or the label for faces of the solid next to an empty cell.
class GridContent {
 public:
  static GridContent solid(std::size_t region) { return GridContent(static_cast<std::int32_t>(region)); }
  static GridContent air(std::size_t label) { return GridContent(-1 - static_cast<std::int32_t>(label)); }

  [[nodiscard]] bool is_solid() const { return code_ >= 0; }
  [[nodiscard]] std::size_t region() const { return static_cast<std::size_t>(code_); }      ///< of a solid
  [[nodiscard]] std::size_t label() const { return static_cast<std::size_t>(-1 - code_); }  ///< of an empty cell

 private:
  explicit GridContent(std::int32_t code) : code_(code) {}
  std::int32_t code_;
};

/// The position in a grid along its three axes.
using GridIndex = std::array<std::size_t, 3>;

/// A grid of cells between grid lines. Each cell is solid or empty.
struct MeshGrid {
  std::array<GridLines, 3> lines;     ///< at least two along each axis
  std::vector<GridContent> contents;  ///< content of cell (i, j, k) at offset(i, j, k)

  [[nodiscard]] GridIndex size() const { return {lines[0].size() - 1, lines[1].size() - 1, lines[2].size() - 1}; }
  [[nodiscard]] std::size_t cell_count() const { return size()[0] * size()[1] * size()[2]; }
  [[nodiscard]] std::size_t offset(const GridIndex& cell) const { return cell[0] + size()[0] * (cell[1] + size()[1] * cell[2]); }
};

/// The labels of the faces at the six ends of a grid, in the order of Side.
using EndLabels = std::array<std::size_t, 6>;

/// The element of each cell of a grid; no_element for empty cells.
using GridElements = std::vector<std::uint32_t>;
inline constexpr std::uint32_t no_element = UINT32_MAX;

/// Fills the points, elements, regions and faces of a mesh from a grid. Every solid cell is an element, in grid order.
///
/// Elements share a point if they are joined there through faces. So solid cells that meet only along an edge or at a corner have
/// separate points there. A face gets the label of the empty cell behind it, or, at the ends of the grid, a label of `ends`.
/// @return the element of each cell
GridElements fill_from_grid(HexahedralMesh& mesh, const MeshGrid& grid, const EndLabels& ends);

}  // namespace menger::meshes
