#include "meshes/design/weak_contacts.h"

#include <array>

namespace menger::meshes {
namespace {

/// Half of the diagonals between cells; the others are the same ones in the opposite direction. Those across an edge come first.
constexpr std::array<CellIndex, 10> diagonals{
    {{1, 1, 0}, {-1, 1, 0}, {1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {1, -1, 1}, {-1, -1, 1}}};

constexpr std::size_t edge_diagonals = 6;

/// Returns whether any cell of the block between two cells is occupied, except for these two.
bool block_has_others(const Polycube& body, const CellIndex& cell, const CellIndex& diagonal) {
  for (int corner = 1; corner < 7; ++corner) {
    const CellIndex step{(corner & 1) != 0 ? diagonal.x : 0, (corner & 2) != 0 ? diagonal.y : 0,
                         (corner & 4) != 0 ? diagonal.z : 0};
    if (step == CellIndex{} || step == diagonal) continue;
    if (body.at_or_empty({cell.x + step.x, cell.y + step.y, cell.z + step.z}) != empty) return true;
  }
  return false;
}

/// Calls `visit` with each pair of cells in weak contact along the first `kinds` diagonals, until it returns false.
template <class Visit>
void for_each_weak_contact(const Polycube& body, std::size_t kinds, const Visit& visit) {
  for (const CellIndex& cell : body.occupied()) {
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      const CellIndex& diagonal = diagonals[kind];
      const CellIndex other{cell.x + diagonal.x, cell.y + diagonal.y, cell.z + diagonal.z};
      if (body.at_or_empty(other) == empty || block_has_others(body, cell, diagonal)) continue;
      if (!visit(WeakContact{cell, other})) return;
    }
  }
}

}  // namespace

// At a corner it is enough that any of the six other cells is occupied. Either it joins the two through faces, or it has an edge
// contact with one of them, which is found separately.
std::optional<WeakContact> first_weak_contact(const Polycube& body) {
  std::optional<WeakContact> first;
  for_each_weak_contact(body, diagonals.size(), [&](const WeakContact& contact) {
    first = contact;
    return false;
  });
  return first;
}

std::size_t count_edge_contacts(const Polycube& body) {
  std::size_t count = 0;
  for_each_weak_contact(body, edge_diagonals, [&](const WeakContact& /*contact*/) {
    ++count;
    return true;
  });
  return count;
}

std::string cell_text(const CellIndex& cell) {
  return "(" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ", " + std::to_string(cell.z) + ")";
}

}  // namespace menger::meshes
