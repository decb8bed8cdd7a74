#include "meshes/design/fractal.h"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace menger::meshes {

namespace {

constexpr std::size_t saturated = std::numeric_limits<std::size_t>::max();

std::size_t product(std::size_t a, std::size_t b) { return b != 0 && a > saturated / b ? saturated : a * b; }

using Sides = std::array<std::size_t, 3>;

Sides sides(const Polycube& body) {
  return {static_cast<std::size_t>(body.nx()), static_cast<std::size_t>(body.ny()), static_cast<std::size_t>(body.nz())};
}

Sides product(const Sides& a, const Sides& b) { return {product(a[0], b[0]), product(a[1], b[1]), product(a[2], b[2])}; }

std::size_t grid_bytes(const Sides& cells) {
  constexpr auto most_cells = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (cells[0] > most_cells || cells[1] > most_cells || cells[2] > most_cells) return saturated;
  return product(product(cells[0], cells[1]), product(cells[2], sizeof(Material)));
}

}  // namespace

Polycube replace_cells(const Polycube& aggregate, const Polycube& body) {
  Polycube result(aggregate.nx() * body.nx(), aggregate.ny() * body.ny(), aggregate.nz() * body.nz());
  const std::vector<CellIndex> pattern = body.occupied();
  for (const CellIndex& block : aggregate.occupied()) {
    for (const CellIndex& cell : pattern) {
      result.set({block.x * body.nx() + cell.x, block.y * body.ny() + cell.y, block.z * body.nz() + cell.z}, body.at(cell));
    }
  }
  return result;
}

Polycube fractal(const Polycube& body, int level, std::size_t largest_grid_bytes) {
  if (level < 1) throw std::invalid_argument("a fractal has level 1 or more, not " + std::to_string(level));
  Sides cells = sides(body);
  for (int reached = 1; reached < level && grid_bytes(cells) <= largest_grid_bytes; ++reached)
    cells = product(cells, sides(body));
  if (grid_bytes(cells) > largest_grid_bytes) {
    throw std::length_error("the grid of level " + std::to_string(level) + " would need more than " +
                            std::to_string(largest_grid_bytes) + " bytes");
  }
  Polycube aggregate = body;
  for (int reached = 1; reached < level; ++reached) aggregate = replace_cells(aggregate, body);
  return aggregate;
}

double hausdorff_dimension(const Polycube& body) {
  if (body.nx() != body.ny() || body.nx() != body.nz()) throw std::invalid_argument("a Hausdorff dimension needs a cubic grid");
  if (body.nx() < 2) throw std::invalid_argument("a Hausdorff dimension needs at least 2 cells per side");
  if (body.count() == 0) throw std::invalid_argument("an empty body has no Hausdorff dimension");
  return std::log(static_cast<double>(body.count())) / std::log(static_cast<double>(body.nx()));
}

}  // namespace menger::meshes
