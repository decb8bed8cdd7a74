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

std::optional<Polycube> basal_body(const Polycube& aggregate, int level) {
  const Sides all = sides(aggregate);
  Sides own{};
  for (std::size_t i = 0; i < 3; ++i) {
    own[i] = static_cast<std::size_t>(std::lround(std::pow(static_cast<double>(all[i]), 1.0 / level)));
    std::size_t power = 1;
    for (int reached = 0; reached < level; ++reached) power = product(power, own[i]);
    if (own[i] == 0 || power != all[i]) return std::nullopt;
  }
  const std::vector<CellIndex> occupied = aggregate.occupied();
  if (occupied.empty()) return std::nullopt;
  // Every smallest block that is not empty is a copy of the body.
  Polycube body(static_cast<int>(own[0]), static_cast<int>(own[1]), static_cast<int>(own[2]));
  const CellIndex& first = occupied.front();
  const CellIndex corner{first.x / body.nx() * body.nx(), first.y / body.ny() * body.ny(), first.z / body.nz() * body.nz()};
  for (int z = 0; z < body.nz(); ++z)
    for (int y = 0; y < body.ny(); ++y)
      for (int x = 0; x < body.nx(); ++x) body.set({x, y, z}, aggregate.at({corner.x + x, corner.y + y, corner.z + z}));
  if (fractal(body, level) != aggregate) return std::nullopt;
  return body;
}

double body_length_m(int level, double cell_edge_m, int cells_per_side) {
  double cells = 1.0;
  for (int i = 0; i < level; ++i) cells *= cells_per_side;
  return cells * cell_edge_m;
}

double hausdorff_dimension(const Polycube& body) {
  if (body.nx() != body.ny() || body.nx() != body.nz()) throw std::invalid_argument("a Hausdorff dimension needs a cubic grid");
  if (body.nx() < 2) throw std::invalid_argument("a Hausdorff dimension needs at least 2 cells per side");
  if (body.count() == 0) throw std::invalid_argument("an empty body has no Hausdorff dimension");
  return std::log(static_cast<double>(body.count())) / std::log(static_cast<double>(body.nx()));
}

}  // namespace menger::meshes
