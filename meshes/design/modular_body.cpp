#include "meshes/design/modular_body.h"

#include <algorithm>
#include <limits>

#include "meshes/design/fractal.h"

namespace menger::meshes {
namespace {

constexpr std::size_t no_region = std::numeric_limits<std::size_t>::max();

/// Returns the direction in which a zone touches a neighbouring cell: -1, 0 or 1.
int direction(WallZone zone) { return (static_cast<int>(zone) > 0 ? 1 : 0) - (static_cast<int>(zone) < 0 ? 1 : 0); }

bool is_outer(WallZone zone) { return zone == WallZone::low_outer || zone == WallZone::high_outer; }

int along(const CellIndex& cell, std::size_t axis) { return std::array{cell.x, cell.y, cell.z}.at(axis); }

CellIndex cell_along(std::size_t axis, int position, int first, int second) {
  if (axis == 0) return {position, first, second};
  if (axis == 1) return {first, position, second};
  return {first, second, position};
}

/// @param plane_past_middle distance of the plane from the middle of the module, of any unit
PartitionPlace place_of(const PlaneWalls& walls, int plane_past_middle) {
  if (walls.partitions == 0 || !walls.has_outer()) return PartitionPlace::centred;
  if (walls.outer_low != walls.outer_high) return walls.outer_low > walls.outer_high ? PartitionPlace::low : PartitionPlace::high;
  return plane_past_middle > 0 ? PartitionPlace::high : PartitionPlace::low;
}

}  // namespace

ModularBody::ModularBody(const Polycube& basal, int level, ChamberLayout layout)
    : module_size_{basal.nx(), basal.ny(), basal.nz()},
      cells_(fractal(basal, level)),
      modules_(level == 1 ? std::vector<CellIndex>{{0, 0, 0}} : fractal(basal, level - 1).occupied()) {
  region_of_cell_.assign(
      static_cast<std::size_t>(cells_.nx()) * static_cast<std::size_t>(cells_.ny()) * static_cast<std::size_t>(cells_.nz()),
      no_region);
  for (std::size_t module = 0; module < modules_.size(); ++module) add_regions(module, layout);
  for (std::size_t axis = 0; axis < 3; ++axis)
    partition_places_[axis].assign(static_cast<std::size_t>(module_size_[axis]), PartitionPlace::centred);
  if (layout == ChamberLayout::per_phase) place_partitions(basal);
}

void ModularBody::add_regions(std::size_t module_position, ChamberLayout layout) {
  const auto [nx, ny, nz] = module_size_;
  const CellIndex module = modules_[module_position];
  for (int z = module.z * nz; z < (module.z + 1) * nz; ++z) {
    for (int y = module.y * ny; y < (module.y + 1) * ny; ++y) {
      for (int x = module.x * nx; x < (module.x + 1) * nx; ++x) {
        const CellIndex cell{x, y, z};
        if (cells_.at(cell) == empty || region_of_cell_[offset(cell)] != no_region) continue;
        regions_.push_back({module_position, cells_.at(cell)});
        fill_region(cell, layout);
      }
    }
  }
}

void ModularBody::fill_region(const CellIndex& seed, ChamberLayout layout) {
  const std::size_t region = regions_.size() - 1;
  std::vector<CellIndex> front{seed};
  region_of_cell_[offset(seed)] = region;
  while (!front.empty()) {
    const CellIndex cell = front.back();
    front.pop_back();
    for (const Side side : all_sides) {
      const CellIndex next = neighbour(cell, side);
      if (!same_module(cell, next) || region_of_cell_[offset(next)] != no_region) continue;
      if (layout == ChamberLayout::per_phase && cells_.at(next) != cells_.at(cell)) continue;
      region_of_cell_[offset(next)] = region;
      front.push_back(next);
    }
  }
}

std::optional<std::size_t> ModularBody::region_of(const CellIndex& cell) const {
  if (cells_.at_or_empty(cell) == empty) return std::nullopt;
  return region_of_cell_[offset(cell)];
}

bool ModularBody::same_module(const CellIndex& a, const CellIndex& b) const {
  if (cells_.at_or_empty(a) == empty || cells_.at_or_empty(b) == empty) return false;
  const auto [nx, ny, nz] = module_size_;
  return a.x / nx == b.x / nx && a.y / ny == b.y / ny && a.z / nz == b.z / nz;
}

PlaneWalls ModularBody::walls_in_plane(std::size_t axis, int plane) const {
  const std::array<int, 3> size{cells_.nx(), cells_.ny(), cells_.nz()};
  const int first_size = axis == 0 ? size[1] : size[0];
  const int second_size = axis == 2 ? size[1] : size[2];
  PlaneWalls walls;
  for (int second = 0; second < second_size; ++second) {
    for (int first = 0; first < first_size; ++first) {
      const CellIndex low = cell_along(axis, plane - 1, first, second);
      const CellIndex high = cell_along(axis, plane, first, second);
      if (same_module(low, high)) {
        if (region_of(low) != region_of(high)) ++walls.partitions;
      } else {
        if (region_of(low)) ++walls.outer_low;
        if (region_of(high)) ++walls.outer_high;
      }
    }
  }
  return walls;
}

void ModularBody::place_partitions(const Polycube& basal) {
  const std::vector<CellIndex> cells = basal.occupied();
  if (cells.empty()) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // The middle is that of the cells, not of their grid, so that a body has the same walls anywhere in it.
    const auto [lowest, highest] = std::ranges::minmax(cells, {}, [&](const CellIndex& cell) { return along(cell, axis); });
    const int twice_the_middle = along(lowest, axis) + along(highest, axis) + 1;
    const int first_plane = along(modules_.front(), axis) * module_size_[axis];
    for (int plane = 1; plane < module_size_[axis]; ++plane)
      partition_places_[axis][static_cast<std::size_t>(plane)] =
          place_of(walls_in_plane(axis, first_plane + plane), 2 * plane - twice_the_middle);
  }
}

PartitionPlace ModularBody::partition_place(std::size_t axis, int plane) const {
  return partition_places_[axis][static_cast<std::size_t>(plane % module_size_[axis])];
}

/// Returns whether a zone of a cell, which is not its middle, lies in the partition beside it, if there is one.
bool ModularBody::is_in_partition(const CellIndex& cell, std::size_t axis, WallZone zone) const {
  const bool is_below_plane = direction(zone) > 0;
  switch (partition_place(axis, along(cell, axis) + (is_below_plane ? 1 : 0))) {
    case PartitionPlace::centred:
      return is_outer(zone);
    case PartitionPlace::low:
      return is_below_plane;
    default:
      return !is_below_plane;
  }
}

bool ModularBody::is_wall(const CellIndex& cell, const CellBlock& block) const {
  const std::array<int, 3> reach{direction(block[0]), direction(block[1]), direction(block[2])};
  // Goes through every neighbour that the block touches: those across sides, edges and the corner.
  for (unsigned axes = 1; axes < 8; ++axes) {
    CellIndex other = cell;
    bool in_partition = true;
    bool is_neighbour = true;
    for (const auto& [axis, coordinate] : {std::pair<std::size_t, int*>{0, &other.x}, {1, &other.y}, {2, &other.z}}) {
      if ((axes >> axis & 1U) == 0) continue;
      is_neighbour = is_neighbour && reach[axis] != 0;
      in_partition = in_partition && is_neighbour && is_in_partition(cell, axis, block[axis]);
      *coordinate += reach[axis];
    }
    if (!is_neighbour) continue;
    if (!same_module(cell, other)) return true;
    if (in_partition && region_of(cell) != region_of(other)) return true;
  }
  return false;
}

std::size_t ModularBody::offset(const CellIndex& cell) const {
  return static_cast<std::size_t>(cell.x) +
         static_cast<std::size_t>(cells_.nx()) *
             (static_cast<std::size_t>(cell.y) + static_cast<std::size_t>(cells_.ny()) * static_cast<std::size_t>(cell.z));
}

CellIndex neighbour(const CellIndex& cell, Side side) {
  const int step = is_max(side) ? 1 : -1;
  switch (axis_of(side)) {
    case 0:
      return {cell.x + step, cell.y, cell.z};
    case 1:
      return {cell.x, cell.y + step, cell.z};
    default:
      return {cell.x, cell.y, cell.z + step};
  }
}

}  // namespace menger::meshes
