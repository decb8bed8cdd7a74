#include "meshes/hexahedra/hollow_volumes.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace menger::meshes {
namespace {

constexpr std::array zones{WallZone::low_outer, WallZone::low_inner, WallZone::middle, WallZone::high_inner,
                           WallZone::high_outer};

/// The number of chamber blocks of a cell by the number of axes (0 to 3) along which they are in the middle zone. An edge of a
/// block is half a wall thickness or the span between walls.
using BlockCounts = std::array<std::size_t, 4>;  ///< index: number of axes in the middle zone

BlockCounts chamber_blocks(const ModularBody& body, const CellIndex& cell) {
  BlockCounts counts{};
  for (const WallZone z : zones) {
    for (const WallZone y : zones) {
      for (const WallZone x : zones) {
        if (body.is_wall(cell, {x, y, z})) continue;
        ++counts[static_cast<std::size_t>((x == WallZone::middle) + (y == WallZone::middle) + (z == WallZone::middle))];
      }
    }
  }
  return counts;
}

}  // namespace

HollowVolumes hollow_volumes(const ModularBody& body, double cell_edge_m, const HollowBodyOptions& options,
                             const std::vector<JointHole>& holes) {
  const double half_wall = 0.5 * options.wall_thickness_m;
  const double span = cell_edge_m - 2.0 * options.wall_thickness_m;
  std::vector<BlockCounts> counts(body.regions().size());
  std::size_t cell_count = 0;
  for (const CellIndex& cell : body.cells().occupied()) {
    const BlockCounts blocks = chamber_blocks(body, cell);
    for (std::size_t kind = 0; kind < blocks.size(); ++kind) counts[*body.region_of(cell)][kind] += blocks[kind];
    ++cell_count;
  }
  HollowVolumes volumes;
  volumes.wall_m3 = static_cast<double>(cell_count) * std::pow(cell_edge_m, 3);
  for (const BlockCounts& blocks : counts) {
    double volume = 0.0;
    for (std::size_t kind = 0; kind < blocks.size(); ++kind) {
      const auto spans = static_cast<int>(kind);
      volume += static_cast<double>(blocks[kind]) * std::pow(span, spans) * std::pow(half_wall, 3 - spans);
    }
    volumes.chambers_m3.push_back(volume);
  }
  for (const JointHole& hole : holes) {
    const double half = options.wall_thickness_m * std::pow(options.hole_edge_m.value_or(0.0), 2);
    volumes.chambers_m3[*body.region_of(hole.cell)] += half;
    volumes.chambers_m3[*body.region_of(neighbour(hole.cell, hole.side))] += half;
  }
  for (const TubeHole& tube : options.tubes)
    volumes.chambers_m3[*body.region_of(tube.cell)] += options.wall_thickness_m * std::pow(tube.edge_m, 2);
  for (const double chamber : volumes.chambers_m3) volumes.wall_m3 -= chamber;
  return volumes;
}

}  // namespace menger::meshes
