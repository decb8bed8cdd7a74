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

/// Where a partition lies, the wall between two chambers of a module whose cells meet in a plane. Its thickness is that of all
/// walls in any place.
enum class PartitionPlace {
  centred,  ///< one half in the cells on either side of the plane
  low,      ///< in the cells below the plane
  high      ///< in the cells above it
};

/// The numbers of sides of cells in a plane between cells that have a wall.
struct PlaneWalls {
  std::size_t outer_low = 0;   ///< cells below the plane whose module ends there
  std::size_t outer_high = 0;  ///< cells above it whose module begins there
  std::size_t partitions = 0;  ///< pairs of cells of one module and different regions

  [[nodiscard]] bool has_outer() const { return outer_low + outer_high > 0; }
  [[nodiscard]] bool any() const { return has_outer() || partitions > 0; }
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

  /// Returns the walls in a plane between cells. @param plane number of the cells above it along the axis
  [[nodiscard]] PlaneWalls walls_in_plane(std::size_t axis, int plane) const;

  /// Returns where the partitions of a plane lie. All partitions of a plane have the same place, and all modules the same places.
  ///
  /// Partitions are centred if no outer wall lies in their plane. Otherwise they lie in the cells on the side on which more outer
  /// walls lie. Their faces then continue those of the outer walls, and no grid line of one cuts the other in two layers. If
  /// there are as many on either side, partitions lie on the side away from the middle of the module, those in the middle on the
  /// low side: mirror images of a body then have mirrored walls, except in this last case.
  [[nodiscard]] PartitionPlace partition_place(std::size_t axis, int plane) const;

  /// Returns whether a block of an occupied cell is wall, not chamber.
  [[nodiscard]] bool is_wall(const CellIndex& cell, const CellBlock& block) const;

 private:
  [[nodiscard]] std::size_t offset(const CellIndex& cell) const;
  void add_regions(std::size_t module_position, ChamberLayout layout);
  void fill_region(const CellIndex& seed, ChamberLayout layout);
  void place_partitions(const Polycube& basal);
  [[nodiscard]] bool is_in_partition(const CellIndex& cell, std::size_t axis, WallZone zone) const;

  std::array<int, 3> module_size_;
  Polycube cells_;
  std::vector<CellIndex> modules_;
  std::vector<Region> regions_;
  std::vector<std::size_t> region_of_cell_;
  std::array<std::vector<PartitionPlace>, 3> partition_places_;  ///< by axis and plane of a module
};

/// Returns the adjacent cell across a side.
CellIndex neighbour(const CellIndex& cell, Side side);

}  // namespace menger::meshes
