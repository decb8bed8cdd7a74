#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "meshes/design/hollow_body_options.h"
#include "meshes/design/polycube.h"

namespace menger::meshes {

/// Part of a cell along one axis, counted from the side that its sign names: the outer half of a wall thickness, the inner half,
/// and what lies between the walls.
enum class WallZone { low_outer = -2, low_inner = -1, middle = 0, high_inner = 1, high_outer = 2 };

/// A zone along each axis: one of the 125 blocks of a cell.
using CellBlock = std::array<WallZone, 3>;

/// The cells of a body of several modules and the chamber that each belongs to.
class ModularBody {
 public:
  /// @param basal face-connected body of which every module is a copy
  /// @param level >= 1, of the fractal @throws std::length_error if its grid would be too large
  ModularBody(const Polycube& basal, int level, ChamberLayout layout);

  /// What a chamber is made from.
  struct Region {
    std::size_t module;  ///< position in modules()
    Material material;   ///< of its first cell
  };

  [[nodiscard]] const Polycube& cells() const { return cells_; }
  [[nodiscard]] const std::vector<CellIndex>& modules() const { return modules_; }  ///< positions in modules, in grid order
  [[nodiscard]] const std::vector<Region>& regions() const { return regions_; }     ///< one per chamber, by module and first cell

  /// The region of a cell; nothing for an empty cell and outside the grid.
  [[nodiscard]] std::optional<std::size_t> region_of(const CellIndex& cell) const;

  /// Whether two occupied or empty cells lie in one module; an empty one lies in none.
  [[nodiscard]] bool same_module(const CellIndex& a, const CellIndex& b) const;

  /// Whether a block of an occupied cell is wall and not chamber.
  [[nodiscard]] bool is_wall(const CellIndex& cell, const CellBlock& block) const;

 private:
  [[nodiscard]] std::size_t offset(const CellIndex& cell) const;
  void add_regions(std::size_t module_position, ChamberLayout layout);
  void fill_region(const CellIndex& seed, ChamberLayout layout);

  std::array<int, 3> module_size_;
  Polycube cells_;
  std::vector<CellIndex> modules_;
  std::vector<Region> regions_;
  std::vector<std::size_t> region_of_cell_;
};

/// The cell on the other side of a side.
CellIndex neighbour(const CellIndex& cell, Side side);

}  // namespace menger::meshes
