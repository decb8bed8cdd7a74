#include "evolution/genome/balance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace menger::evolution {

bool is_balanced(const meshes::Polycube& body) {
  const std::vector<meshes::CellIndex> cells = body.occupied();
  if (cells.empty()) return false;
  const int lowest = std::ranges::min(cells, {}, &meshes::CellIndex::z).z;
  double x = 0.0;
  double y = 0.0;
  for (const meshes::CellIndex& cell : cells) {
    x += (cell.x + 0.5) / static_cast<double>(cells.size());
    y += (cell.y + 0.5) / static_cast<double>(cells.size());
  }
  // A point is inside of a convex hull exactly if, seen from it, directions to corners that follow each other are less than half
  // a turn apart.
  std::vector<double> directions;
  for (const meshes::CellIndex& cell : cells) {
    if (cell.z != lowest) continue;
    for (const int right : {0, 1}) {
      for (const int far : {0, 1}) directions.push_back(std::atan2(cell.y + far - y, cell.x + right - x));
    }
  }
  std::ranges::sort(directions);
  double widest = directions.front() + 2.0 * std::numbers::pi - directions.back();
  for (std::size_t n = 1; n < directions.size(); ++n) widest = std::max(widest, directions[n] - directions[n - 1]);
  constexpr double rounding = 1e-9;
  return widest < std::numbers::pi - rounding;
}

}  // namespace menger::evolution
