#include "fem/explicit_walls.h"

#include <algorithm>
#include <limits>

namespace menger::fem {
namespace {

Point point_at(std::span<const double> positions, std::size_t node) {
  return {positions[3 * node], positions[3 * node + 1], positions[3 * node + 2]};
}

}  // namespace

ExplicitWalls::ExplicitWalls(const meshes::HexahedralMesh& mesh) : shortest_edge_(std::numeric_limits<double>::infinity()) {
  constexpr std::array<std::size_t, 4> row_by_row{0, 1, 3, 2};  // of corners that run around
  for (const meshes::Chamber& chamber : mesh.chambers) {
    Walls& walls = chambers_.emplace_back();
    std::vector<std::size_t> index(mesh.points.size(), mesh.points.size());
    for (const meshes::BoundaryFace& boundary : mesh.faces) {
      if (std::find(chamber.labels.begin(), chamber.labels.end(), boundary.label) == chamber.labels.end()) continue;
      auto& face = walls.faces.emplace_back();
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t node = boundary.corners[row_by_row[c]];
        if (index[node] == mesh.points.size()) {
          index[node] = walls.nodes.size();
          walls.nodes.push_back(node);
        }
        face[c] = index[node];
        const Point edge = difference(mesh.points[boundary.corners[(c + 1) % 4]], mesh.points[boundary.corners[c]]);
        shortest_edge_ = std::min(shortest_edge_, norm(edge));
      }
    }
  }
}

std::optional<ChamberGap> ExplicitWalls::smallest_gap(std::span<const double> positions_m) const {
  std::optional<ChamberGap> smallest;
  for (std::size_t c = 0; c < chambers_.size(); ++c) {
    std::vector<Point> points;
    points.reserve(chambers_[c].nodes.size());
    for (const std::size_t node : chambers_[c].nodes) points.push_back(point_at(positions_m, node));
    const auto gap = smallest_wall_gap(std::span<const std::array<std::size_t, 4>>(chambers_[c].faces), points,
                                       0.5 * shortest_edge_, reach_m());
    if (gap && (!smallest || gap->gap_m < smallest->gap.gap_m)) smallest = {c, *gap};
  }
  return smallest;
}

double ExplicitWalls::travel_m(std::span<const double> from_m, std::span<const double> to_m) const {
  double largest = 0.0;
  for (const Walls& walls : chambers_) {
    Point mean{};
    for (const std::size_t node : walls.nodes) mean = sum(mean, difference(point_at(to_m, node), point_at(from_m, node)));
    mean = scaled(1.0 / static_cast<double>(walls.nodes.size()), mean);
    for (const std::size_t node : walls.nodes)
      largest = std::max(largest, norm(difference(difference(point_at(to_m, node), point_at(from_m, node)), mean)));
  }
  return largest;
}

double ExplicitWalls::allowed_travel_m(const std::optional<ChamberGap>& gap) const {
  return std::max(0.25 * shortest_edge_, 0.5 * (gap ? gap->gap.gap_m : reach_m()));
}

}  // namespace menger::fem
