#include "meshes/design/modular_body.h"

#include <limits>

#include "meshes/design/fractal.h"

namespace menger::meshes {
namespace {

constexpr std::size_t no_region = std::numeric_limits<std::size_t>::max();

/// Returns the direction in which a zone touches a neighbouring cell: -1, 0 or 1.
int direction(WallZone zone) { return (static_cast<int>(zone) > 0 ? 1 : 0) - (static_cast<int>(zone) < 0 ? 1 : 0); }

bool is_outer(WallZone zone) { return zone == WallZone::low_outer || zone == WallZone::high_outer; }

}  // namespace

ModularBody::ModularBody(const Polycube& basal, int level, ChamberLayout layout)
    : module_size_{basal.nx(), basal.ny(), basal.nz()},
      cells_(fractal(basal, level)),
      modules_(level == 1 ? std::vector<CellIndex>{{0, 0, 0}} : fractal(basal, level - 1).occupied()) {
  region_of_cell_.assign(
      static_cast<std::size_t>(cells_.nx()) * static_cast<std::size_t>(cells_.ny()) * static_cast<std::size_t>(cells_.nz()),
      no_region);
  for (std::size_t module = 0; module < modules_.size(); ++module) add_regions(module, layout);
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

bool ModularBody::is_wall(const CellIndex& cell, const CellBlock& block) const {
  const std::array<int, 3> reach{direction(block[0]), direction(block[1]), direction(block[2])};
  // Goes through every neighbour that the block touches: those across sides, edges and the corner.
  for (unsigned axes = 1; axes < 8; ++axes) {
    CellIndex other = cell;
    bool within_half = true;
    bool is_neighbour = true;
    for (const auto& [axis, coordinate] : {std::pair<std::size_t, int*>{0, &other.x}, {1, &other.y}, {2, &other.z}}) {
      if ((axes >> axis & 1U) == 0) continue;
      is_neighbour = is_neighbour && reach[axis] != 0;
      within_half = within_half && is_outer(block[axis]);
      *coordinate += reach[axis];
    }
    if (!is_neighbour) continue;
    if (!same_module(cell, other)) return true;
    if (within_half && region_of(cell) != region_of(other)) return true;
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
