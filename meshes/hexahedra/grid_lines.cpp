#include "meshes/hexahedra/grid_lines.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace menger::meshes {
namespace {

/// The relative difference below which two lengths count as equal: far above rounding, far below any edge.
constexpr double same = 1e-9;

/// A part of an axis that is cut into edges.
struct Span {
  double begin;
  double end;
  bool in_wall;  ///< cut into equal edges, a fraction of the wall thickness
};

std::array<int, 3> size_of(const Polycube& cells) { return {cells.nx(), cells.ny(), cells.nz()}; }

/// Returns the lines that a plane at `position` needs, in increasing order. Partitions need lines of their own only where they
/// are centred; otherwise they lie between those of outer walls.
GridLines lines_beside(const PlaneWalls& walls, double position, double wall) {
  if (!walls.has_outer()) return {position - 0.5 * wall, position + 0.5 * wall};
  GridLines lines;
  if (walls.outer_low > 0) lines.push_back(position - wall);
  lines.push_back(position);
  if (walls.outer_high > 0) lines.push_back(position + wall);
  return lines;
}

/// Returns the positions where holes begin and end along an axis.
std::set<double> hole_lines(std::size_t axis, double cell_edge, const HollowBodyOptions& options,
                            const std::vector<JointHole>& holes) {
  std::set<double> lines;
  const auto add = [&](const CellIndex& cell, Side side, double hole_edge) {
    if (axis_of(side) == axis) return;
    const double middle = (std::array{cell.x, cell.y, cell.z}[axis] + 0.5) * cell_edge;
    lines.insert({middle - 0.5 * hole_edge, middle + 0.5 * hole_edge});
  };
  for (const JointHole& hole : holes) add(hole.cell, hole.side, options.hole_edge_m.value_or(0.0));
  for (const TubeHole& tube : options.tubes) add(tube.cell, tube.side, tube.edge_m);
  return lines;
}

std::vector<Span> spans(const ModularBody& body, std::size_t axis, double cell_edge, const HollowBodyOptions& options,
                        const std::vector<JointHole>& holes) {
  const double tolerance = same * cell_edge;
  const std::set<double> holes_here = hole_lines(axis, cell_edge, options, holes);
  std::vector<Span> result;
  double reached = 0.0;
  bool begun = false;
  for (int plane = 0; plane <= size_of(body.cells())[axis]; ++plane) {
    const PlaneWalls walls = body.walls_in_plane(axis, plane);
    if (!walls.any()) continue;
    const GridLines lines = lines_beside(walls, plane * cell_edge, options.wall_thickness_m);
    if (begun) {
      // Holes lie between the walls of their cells, so their lines lie in the spans between walls.
      for (auto line = holes_here.lower_bound(reached + tolerance); line != holes_here.end() && *line < lines.front() - tolerance;
           ++line) {
        if (*line - reached < tolerance) continue;
        result.push_back({reached, *line, false});
        reached = *line;
      }
      result.push_back({reached, lines.front(), false});
    }
    for (std::size_t i = 1; i < lines.size(); ++i) result.push_back({lines[i - 1], lines[i], true});
    reached = lines.back();
    begun = true;
  }
  return result;
}

}  // namespace

std::vector<double> equal_edges(double span, double largest) {
  const double count = std::max(1.0, std::ceil(span / largest - same));
  return std::vector<double>(static_cast<std::size_t>(count), span / count);
}

std::vector<double> graded_edges(double span, double first, double growth, double largest) {
  if (growth <= 1.0 || largest <= first) return equal_edges(span, std::min(first, largest));
  // Edges are added in pairs, one at each end, until the next pair or a last single edge in the middle fills the span.
  std::vector<double> half;
  double edge = first;
  double sum = 0.0;
  const double enough = span * (1.0 - same);
  while (sum + edge < enough) {
    half.push_back(edge);
    sum += 2.0 * edge;
    if (sum >= enough) break;
    edge = std::min(edge * growth, largest);
  }
  std::vector<double> edges = half;
  if (sum < enough) edges.push_back(edge);
  edges.insert(edges.end(), half.rbegin(), half.rend());
  const double total = std::accumulate(edges.begin(), edges.end(), 0.0);
  for (double& each : edges) each *= span / total;
  return edges;
}

std::array<GridLines, 3> grid_lines(const ModularBody& body, double cell_edge_m, const HollowBodyOptions& options,
                                    const std::vector<JointHole>& holes) {
  const double wall = options.wall_thickness_m;
  const double wall_edge = wall / options.elements_through_wall;
  const auto span_edges = [&](double length) {
    if (options.elements_per_span) return equal_edges(length, (cell_edge_m - 2.0 * wall) / *options.elements_per_span);
    return graded_edges(length, wall_edge, options.growth, options.largest_element_m.value_or(wall_edge));
  };
  std::array<GridLines, 3> lines;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const Span& span : spans(body, axis, cell_edge_m, options, holes)) {
      const double length = span.end - span.begin;
      if (lines[axis].empty()) lines[axis].push_back(span.begin);
      const std::vector<double> edges = span.in_wall ? equal_edges(length, wall_edge) : span_edges(length);
      double at = span.begin;
      for (std::size_t i = 0; i + 1 < edges.size(); ++i) lines[axis].push_back(at += edges[i]);
      lines[axis].push_back(span.end);
    }
  }
  return lines;
}

}  // namespace menger::meshes
