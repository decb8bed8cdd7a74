#include "voxel/model/hollow_voxels.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "meshes/design/modular_body.h"
#include "voxel/model/voxel_classes.h"

namespace menger::voxel {
namespace {

using meshes::CellIndex;
using meshes::WallZone;

constexpr std::array zones{WallZone::low_outer, WallZone::low_inner, WallZone::middle, WallZone::high_inner,
                           WallZone::high_outer};

/// The part of a zone of a cell that lies in a voxel, along one axis.
struct Slice {
  double length = 0.0;         ///< m
  double second_moment = 0.0;  ///< of the length about the middle of the voxel, m^3
};

/// Slices by the position of the voxel in its cell, then by zone.
using Slices = std::vector<std::array<Slice, zones.size()>>;

Slices slices(const HollowOptions& options) {
  const double edge = options.cell_edge_m;
  const double wall = options.wall_thickness_m;
  const std::array<double, zones.size() + 1> cuts{0.0, 0.5 * wall, wall, edge - wall, edge - 0.5 * wall, edge};
  const double voxel_edge = edge / options.voxels_per_cell;
  Slices result(static_cast<std::size_t>(options.voxels_per_cell));
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double low = static_cast<double>(i) * voxel_edge;
    const double middle = low + 0.5 * voxel_edge;
    for (std::size_t zone = 0; zone < zones.size(); ++zone) {
      const double from = std::max(cuts[zone], low) - middle;
      const double to = std::min(cuts[zone + 1], low + voxel_edge) - middle;
      if (to > from) result[i][zone] = {to - from, (to * to * to - from * from * from) / 3.0};
    }
  }
  return result;
}

/// Volume of the wall in a voxel and its second moment, the integral of r^2 about the middle of the voxel.
struct WallShape {
  double volume = 0.0;         ///< m^3
  double second_moment = 0.0;  ///< m^5
};

WallShape wall_shape(const meshes::ModularBody& body, const CellIndex& cell, const std::array<Slice, zones.size()>& along_x,
                     const std::array<Slice, zones.size()>& along_y, const std::array<Slice, zones.size()>& along_z) {
  WallShape wall;
  for (std::size_t k = 0; k < zones.size(); ++k) {
    for (std::size_t j = 0; j < zones.size(); ++j) {
      for (std::size_t i = 0; i < zones.size(); ++i) {
        const Slice x = along_x[i];
        const Slice y = along_y[j];
        const Slice z = along_z[k];
        const double volume = x.length * y.length * z.length;
        if (volume == 0.0 || !body.is_wall(cell, {zones[i], zones[j], zones[k]})) continue;
        wall.volume += volume;
        wall.second_moment +=
            x.second_moment * y.length * z.length + x.length * y.second_moment * z.length + x.length * y.length * z.second_moment;
      }
    }
  }
  return wall;
}

meshes::Polycube split_cells(const meshes::Polycube& cells, int parts) {
  meshes::Polycube voxels(cells.nx() * parts, cells.ny() * parts, cells.nz() * parts);
  for (int z = 0; z < voxels.nz(); ++z) {
    for (int y = 0; y < voxels.ny(); ++y) {
      for (int x = 0; x < voxels.nx(); ++x) voxels.set({x, y, z}, cells.at({x / parts, y / parts, z / parts}));
    }
  }
  return voxels;
}

/// Returns the walled sides of a voxel: those behind which there is another chamber or no cell.
std::array<bool, 6> walled_sides(const ChamberVoxels& chamber, const CellIndex& voxel) {
  std::array<bool, 6> walled{};
  for (const meshes::Side side : meshes::all_sides)
    walled[static_cast<std::size_t>(side)] = !chamber.contains(meshes::neighbour(voxel, side));
  return walled;
}

/// Returns which of the walled sides have a cell of the same module behind them.
std::array<bool, 6> shared_sides(const meshes::ModularBody& body, const CellIndex& cell, const std::array<bool, 6>& walled) {
  std::array<bool, 6> shared{};
  for (const meshes::Side side : meshes::all_sides) {
    const auto at = static_cast<std::size_t>(side);
    shared[at] = walled[at] && body.same_module(cell, meshes::neighbour(cell, side));
  }
  return shared;
}

void check(const HollowOptions& options) {
  if (!(options.wall_thickness_m > 0.0 && 2.0 * options.wall_thickness_m < options.cell_edge_m))
    throw std::invalid_argument("a wall must be thinner than half a cell, and thicker than nothing");
  if (options.voxels_per_cell < 1) throw std::invalid_argument("a cell has at least one voxel along an edge");
}

}  // namespace

HollowVoxels hollow_voxels(const meshes::Polycube& basal_body, const HollowOptions& options) {
  check(options);
  const meshes::ModularBody body(basal_body, options.level, options.chambers);
  const int parts = options.voxels_per_cell;
  const Slices slice = slices(options);
  const double voxel_edge = options.cell_edge_m / parts;
  HollowVoxels voxels;
  voxels.body = split_cells(body.cells(), parts);
  voxels.chamber_count = body.regions().size();
  for (const CellIndex& voxel : voxels.body.occupied()) {
    const CellIndex cell{voxel.x / parts, voxel.y / parts, voxel.z / parts};
    const std::array<int, 3> part{voxel.x % parts, voxel.y % parts, voxel.z % parts};
    const ChamberVoxels chamber(body, cell, parts);
    voxels.walled.push_back(walled_sides(chamber, voxel));
    voxels.shared.push_back(shared_sides(body, cell, voxels.walled.back()));
    const VoxelClasses classes = classes_of_voxel(chamber, voxel);
    voxels.wall_class.push_back(classes.wall);
    voxels.bulge_class.push_back(classes.bulge);
    voxels.half_class.push_back(classes.half);
    voxels.size_class.push_back(classes.size);
    voxels.chamber.push_back(body.region_of(cell).value());
    const WallShape wall = wall_shape(body, cell, slice[static_cast<std::size_t>(part[0])],
                                      slice[static_cast<std::size_t>(part[1])], slice[static_cast<std::size_t>(part[2])]);
    voxels.wall_volume_m3.push_back(wall.volume);
    // The integral of r^2 over a solid cube is volume L^2 / 4.
    voxels.inertia_factor.push_back(wall.volume > 0.0 ? 4.0 * wall.second_moment / (wall.volume * voxel_edge * voxel_edge) : 1.0);
  }
  return voxels;
}

ByLawClass<bool> law_classes_of(const HollowVoxels& voxels) {
  ByLawClass<bool> classes{};
  const auto note = [&classes](const auto& of_voxels) {
    for (const auto& of_voxel : of_voxels) {
      for (const std::uint8_t c : of_voxel) classes[c] = true;
    }
  };
  note(voxels.half_class);
  note(voxels.wall_class);
  note(voxels.bulge_class);
  return classes;
}

std::vector<double> voxel_masses(const HollowVoxels& voxels, double density_kg_m3, double smallest_share) {
  std::vector<double> masses;
  double total = 0.0;
  for (const double volume : voxels.wall_volume_m3) {
    masses.push_back(volume * density_kg_m3);
    total += masses.back();
  }
  const double smallest = smallest_share * total / static_cast<double>(masses.size());
  // The mass added to light voxels is taken from the others in proportion. That may push more voxels below the bound; each voxel
  // is lifted at most once.
  std::vector<bool> lifted(masses.size(), false);
  for (bool again = true; again;) {
    again = false;
    double above = 0.0;
    double rest = total;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      if (!lifted[i] && masses[i] < smallest) {
        masses[i] = smallest;
        lifted[i] = again = true;
      }
      (lifted[i] ? rest : above) += lifted[i] ? -smallest : masses[i];
    }
    if (!again) break;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      if (!lifted[i]) masses[i] *= rest / above;
    }
  }
  return masses;
}

}  // namespace menger::voxel
