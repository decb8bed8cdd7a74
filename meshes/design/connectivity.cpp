#include "meshes/design/connectivity.h"

#include <array>
#include <utility>
#include <vector>

namespace menger::meshes {

namespace {

constexpr std::array<CellIndex, 6> face_neighbours{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

/// Removes the component of `seed` from `rest` and returns its cells. It uses a list of cells, because recursion would overflow
/// the stack for a body of level 3.
std::vector<CellIndex> take_component(Polycube& rest, const CellIndex& seed) {
  std::vector<CellIndex> cells{seed};
  rest.set(seed, empty);
  for (std::size_t next = 0; next < cells.size(); ++next) {
    const CellIndex cell = cells[next];
    for (const CellIndex& step : face_neighbours) {
      const CellIndex neighbour{cell.x + step.x, cell.y + step.y, cell.z + step.z};
      if (rest.at_or_empty(neighbour) == empty) continue;
      rest.set(neighbour, empty);
      cells.push_back(neighbour);
    }
  }
  return cells;
}

/// Calls `visit` with the cells of each component, in the order of their first cells.
template <class Visit>
void for_each_component(const Polycube& body, const Visit& visit) {
  Polycube rest = body;
  for (const CellIndex& cell : body.occupied()) {
    if (rest.at(cell) != empty) visit(take_component(rest, cell));
  }
}

}  // namespace

std::size_t count_components(const Polycube& body) {
  std::size_t components = 0;
  for_each_component(body, [&](const std::vector<CellIndex>& /*cells*/) { ++components; });
  return components;
}

bool is_connected(const Polycube& body) { return count_components(body) == 1; }

Polycube largest_component(const Polycube& body) {
  std::vector<CellIndex> largest;
  for_each_component(body, [&](std::vector<CellIndex> cells) {
    if (cells.size() > largest.size()) largest = std::move(cells);
  });
  if (largest.empty()) return body;
  Polycube kept(body.nx(), body.ny(), body.nz());
  for (const CellIndex& cell : largest) kept.set(cell, body.at(cell));
  return kept;
}

}  // namespace menger::meshes
