#include "meshes/hexahedra/channels.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace menger::meshes {
namespace {

/// Returns the number of the grid line at a position. There must be a line there.
std::size_t line_at(const GridLines& lines, double position) {
  const auto above = std::lower_bound(lines.begin(), lines.end(), position);
  if (above == lines.begin()) return 0;
  const bool nearer_below = above == lines.end() || position - *(above - 1) < *above - position;
  return static_cast<std::size_t>(above - lines.begin()) - (nearer_below ? 1 : 0);
}

Channel channel(const std::array<GridLines, 3>& lines, const CellIndex& cell, Side side, double cell_edge, double wall,
                double hole_edge) {
  Channel result{0, 0, side, {}, {}};
  const std::array<int, 3> position{cell.x, cell.y, cell.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = (position[axis] + 0.5) * cell_edge - 0.5 * hole_edge;
    double high = (position[axis] + 0.5) * cell_edge + 0.5 * hole_edge;
    if (axis == axis_of(side)) {
      low = is_max(side) ? (position[axis] + 1) * cell_edge - wall : position[axis] * cell_edge;
      high = is_max(side) ? (position[axis] + 1) * cell_edge : position[axis] * cell_edge + wall;
    }
    result.begin[axis] = line_at(lines[axis], low);
    result.end[axis] = line_at(lines[axis], high);
    assert(result.begin[axis] < result.end[axis]);
  }
  return result;
}

}  // namespace

std::vector<Channel> channels(const std::array<GridLines, 3>& lines, const ModularBody& body, double cell_edge_m,
                              const HollowBodyOptions& options, const std::vector<JointHole>& holes,
                              const std::vector<std::size_t>& chamber_labels, const std::vector<std::size_t>& tube_labels) {
  std::vector<Channel> result;
  const auto add = [&](const CellIndex& cell, Side side, double hole_edge) -> Channel& {
    Channel& added = result.emplace_back(channel(lines, cell, side, cell_edge_m, options.wall_thickness_m, hole_edge));
    added.chamber = *body.region_of(cell);
    added.label = chamber_labels[added.chamber];
    return added;
  };
  for (const JointHole& hole : holes) {
    add(hole.cell, hole.side, options.hole_edge_m.value_or(0.0));
    add(neighbour(hole.cell, hole.side), opposite(hole.side), options.hole_edge_m.value_or(0.0));
  }
  for (std::size_t tube = 0; tube < options.tubes.size(); ++tube)
    add(options.tubes[tube].cell, options.tubes[tube].side, options.tubes[tube].edge_m).label = tube_labels[tube];
  return result;
}

Cap cap_of(const Channel& channel, const HexahedralMesh& mesh, const MeshGrid& grid, const GridElements& element_of_cell) {
  const std::size_t axis = axis_of(channel.side);
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const std::size_t plane = is_max(channel.side) ? channel.end[axis] : channel.begin[axis];
  // Points are taken from the elements of the wall beside the rim, because points that coincide are not always shared.
  const std::size_t layer = is_max(channel.side) ? plane - 1 : plane;
  const auto point_of_wall = [&](std::size_t wall_u, std::size_t wall_v, std::size_t at_u, std::size_t at_v) {
    GridIndex cell{};
    cell[axis] = layer;
    cell[u] = wall_u;
    cell[v] = wall_v;
    const std::size_t corner = (plane - layer) << axis | (at_u - wall_u) << u | (at_v - wall_v) << v;
    return mesh.elements[element_of_cell[grid.offset(cell)]][corner];
  };
  Cap cap;
  const auto add = [&](std::size_t wall_u, std::size_t wall_v, const GridIndex& from, const GridIndex& to) {
    const std::size_t first = point_of_wall(wall_u, wall_v, from[0], from[1]);
    const std::size_t second = point_of_wall(wall_u, wall_v, to[0], to[1]);
    cap.rim.push_back(is_max(channel.side) ? std::array{first, second} : std::array{second, first});
  };
  const std::size_t u0 = channel.begin[u];
  const std::size_t u1 = channel.end[u];
  const std::size_t v0 = channel.begin[v];
  const std::size_t v1 = channel.end[v];
  // Counterclockwise around the axis of the side.
  for (std::size_t i = u0; i < u1; ++i) add(i, v0 - 1, {i, v0, 0}, {i + 1, v0, 0});
  for (std::size_t i = v0; i < v1; ++i) add(u1, i, {u1, i, 0}, {u1, i + 1, 0});
  for (std::size_t i = u1; i > u0; --i) add(i - 1, v1, {i, v1, 0}, {i - 1, v1, 0});
  for (std::size_t i = v1; i > v0; --i) add(u0 - 1, i - 1, {u0, i, 0}, {u0, i - 1, 0});
  if (!is_max(channel.side)) std::reverse(cap.rim.begin(), cap.rim.end());
  return cap;
}

}  // namespace menger::meshes
