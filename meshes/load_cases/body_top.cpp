#include "meshes/load_cases/body_top.h"

#include <algorithm>
#include <limits>

namespace menger::meshes {

BodyTop top_of(const std::vector<std::array<int, 3>>& cells) {
  std::array<int, 3> low = cells.front();
  std::array<int, 3> high = low;
  for (const auto& cell : cells) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], cell[axis]);
      high[axis] = std::max(high[axis], cell[axis] + 1);
    }
  }
  // Twice the distances, so that they are whole numbers and ties are exact.
  const std::array<int, 2> middle{low[0] + high[0], low[1] + high[1]};
  BodyTop top;
  int least = std::numeric_limits<int>::max();
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const auto& cell = cells[n];
    if (cell[2] + 1 != high[2]) continue;
    const int dx = 2 * cell[0] + 1 - middle[0];
    const int dy = 2 * cell[1] + 1 - middle[1];
    const int distance = dx * dx + dy * dy;
    if (distance > least) continue;
    if (distance < least) top.cells.clear();
    least = distance;
    top.cells.push_back(n);
  }
  for (const std::size_t n : top.cells) {
    const auto& cell = cells[n];
    const auto within = [](int m, int begin) { return std::clamp(0.5 * m, static_cast<double>(begin), begin + 1.0); };
    const std::array<double, 3> point{within(middle[0], cell[0]), within(middle[1], cell[1]), static_cast<double>(high[2])};
    const auto towards = [&](std::size_t axis) { return static_cast<int>(2.0 * (point[axis] - cell[axis]) - 1.0); };
    top.towards.push_back({towards(0), towards(1)});
    top.is_open = point[0] != 0.5 * middle[0] || point[1] != 0.5 * middle[1];
    if (std::find(top.points.begin(), top.points.end(), point) == top.points.end()) top.points.push_back(point);
  }
  return top;
}

}  // namespace menger::meshes
