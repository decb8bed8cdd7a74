#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "meshes/design/hollow_body_options.h"
#include "meshes/design/polycube.h"

namespace menger::meshes {

/// The zones of a cell along one axis. Next to the low and the high side there is one wall thickness, divided into an outer and
/// an inner half. `middle` is the space between the walls.
enum class WallZone { low_outer = -2, low_inner = -1, middle = 0, high_inner = 1, high_outer = 2 };

/// A zone along each axis: one of the 125 blocks of a cell.
using CellBlock = std::array<WallZone, 3>;

/// Where the walls between chambers lie that a plane between cells has.
enum class PartitionPlace {
  centred,  ///< half of their thickness in the cells on either side
  lower,    ///< wholly in the cells below the plane
  upper     ///< wholly in the cells above the plane
};

/// The cells of a body of several modules, and the chamber of each cell.
class ModularBody {
 public:
  /// @param basal face-connected body; every module is a copy of it
  /// @param level level of the fractal, >= 1
  /// @throws std::length_error if the grid would be too large
  ModularBody(const Polycube& basal, int level, ChamberLayout layout);

  /// The module and the material of a chamber.
  struct Region {
    std::size_t module;  ///< position in modules()
    Material material;   ///< material of its first cell
  };

  [[nodiscard]] const Polycube& cells() const { return cells_; }
  [[nodiscard]] const std::vector<CellIndex>& modules() const { return modules_; }  ///< positions in modules, in grid order
  [[nodiscard]] const std::vector<Region>& regions() const { return regions_; }     ///< one per chamber, by module and first cell

  /// Returns the region of a cell; nothing for an empty cell or outside the grid.
  [[nodiscard]] std::optional<std::size_t> region_of(const CellIndex& cell) const;

  /// Returns whether two cells lie in the same module. An empty cell lies in no module.
  [[nodiscard]] bool same_module(const CellIndex& a, const CellIndex& b) const;

  /// Returns where the walls between chambers lie in a plane. Outer walls lie in their own cells: where a plane has some too,
  /// those between chambers lie on their side, so that one layer of elements is as thick as either.
  /// @param axis normal to the plane
  /// @param plane position of the cells above it along the axis
  [[nodiscard]] PartitionPlace partition_place(std::size_t axis, int plane) const {
    return partition_places_[axis][static_cast<std::size_t>(plane)];
  }

  /// Returns whether a block of an occupied cell is wall, not chamber.
  [[nodiscard]] bool is_wall(const CellIndex& cell, const CellBlock& block) const;

 private:
  [[nodiscard]] std::size_t offset(const CellIndex& cell) const;
  void add_regions(std::size_t module_position, ChamberLayout layout);
  void fill_region(const CellIndex& seed, ChamberLayout layout);
  [[nodiscard]] PartitionPlace chosen_partition_place(std::size_t axis, int plane) const;

  std::array<int, 3> module_size_;
  Polycube cells_;
  std::vector<CellIndex> modules_;
  std::vector<Region> regions_;
  std::vector<std::size_t> region_of_cell_;
  std::array<std::vector<PartitionPlace>, 3> partition_places_;
};

/// Returns the cell at a position along an axis, and at two positions along the other axes, in their order.
CellIndex cell_along(std::size_t axis, int position, int first, int second);

/// Returns the adjacent cell across a side.
CellIndex neighbour(const CellIndex& cell, Side side);

}  // namespace menger::meshes
