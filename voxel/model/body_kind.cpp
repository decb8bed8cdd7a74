#include "voxel/model/body_kind.h"

#include <algorithm>
#include <vector>

namespace menger::voxel {
namespace {

using meshes::CellIndex;
using meshes::Polycube;

constexpr std::array<CellIndex, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

CellIndex moved(const CellIndex& cell, const CellIndex& by, int steps) {
  return {cell.x + steps * by.x, cell.y + steps * by.y, cell.z + steps * by.z};
}

bool is_there(const Polycube& body, const CellIndex& at) { return body.at_or_empty(at) != meshes::empty; }

/// Whether a cell is one of four that form a square across two axes.
bool is_in_square(const Polycube& body, const CellIndex& cell, const CellIndex& one, const CellIndex& other) {
  for (const int along_one : {-1, 1}) {
    for (const int along_other : {-1, 1}) {
      const CellIndex beside = moved(cell, one, along_one);
      if (is_there(body, beside) && is_there(body, moved(cell, other, along_other)) &&
          is_there(body, moved(beside, other, along_other)))
        return true;
    }
  }
  return false;
}

bool is_in_square(const Polycube& body, const CellIndex& cell) {
  return is_in_square(body, cell, axes[0], axes[1]) || is_in_square(body, cell, axes[1], axes[2]) ||
         is_in_square(body, cell, axes[2], axes[0]);
}

/// Whether two cells that follow each other along an axis have an edge that points inwards between two sides: a neighbour on each
/// of these, and nothing diagonally between the neighbours.
bool has_long_inner_edge(const Polycube& body, const CellIndex& cell, const CellIndex& one, const CellIndex& other,
                         const CellIndex& along) {
  const auto has_edge = [&](const CellIndex& at, int to_one, int to_other) {
    const CellIndex beside = moved(at, one, to_one);
    return is_there(body, at) && is_there(body, beside) && is_there(body, moved(at, other, to_other)) &&
           !is_there(body, moved(beside, other, to_other));
  };
  for (const int to_one : {-1, 1}) {
    for (const int to_other : {-1, 1}) {
      if (has_edge(cell, to_one, to_other) && has_edge(moved(cell, along, 1), to_one, to_other)) return true;
    }
  }
  return false;
}

bool has_long_inner_edge(const Polycube& body, const CellIndex& cell) {
  return has_long_inner_edge(body, cell, axes[0], axes[1], axes[2]) ||
         has_long_inner_edge(body, cell, axes[1], axes[2], axes[0]) || has_long_inner_edge(body, cell, axes[2], axes[0], axes[1]);
}

bool is_flat(const std::vector<CellIndex>& cells) {
  const auto in_one_layer = [&cells](int CellIndex::*coordinate) {
    return std::all_of(cells.begin(), cells.end(),
                       [&](const CellIndex& cell) { return cell.*coordinate == cells.front().*coordinate; });
  };
  return in_one_layer(&CellIndex::x) || in_one_layer(&CellIndex::y) || in_one_layer(&CellIndex::z);
}

struct KindNames {
  std::string_view word;
  std::string_view name;
  std::string_view plural;
};

constexpr ByBodyKind<KindNames> kind_names{
    {{"limbs", "a body of limbs", "bodies of limbs"},
     {"flat_plate", "a flat plate", "flat plates"},
     {"stepped", "a stepped body (an inner edge of two cells or more)", "stepped bodies"},
     {"plate_on_legs", "a plate on legs", "plates on legs"},
     {"plate_with_limbs", "a plate with limbs", "plates with limbs"},
     {"block", "a block (every cell in a square of four)", "blocks"},
     {"aggregate_of_limbs", "an aggregate of limbs", "aggregates of limbs"},
     {"aggregate_of_stepped_bodies", "an aggregate of stepped bodies", "aggregates of stepped bodies"},
     {"aggregate_of_plates", "an aggregate of plates", "aggregates of plates"}}};

const KindNames& names_of(BodyKind kind) { return kind_names.at(static_cast<std::size_t>(kind)); }

}  // namespace

BodyKind kind_of(const Polycube& basal_body, int level) {
  const std::vector<CellIndex> cells = basal_body.occupied();  // the lowest layer first
  const auto in_square = [&basal_body](const CellIndex& cell) { return is_in_square(basal_body, cell); };
  const auto is_lowest = [&cells](const CellIndex& cell) { return cell.z == cells.front().z; };
  const bool has_squares = std::any_of(cells.begin(), cells.end(), in_square);
  const bool is_stepped =
      std::any_of(cells.begin(), cells.end(), [&](const CellIndex& cell) { return has_long_inner_edge(basal_body, cell); });
  if (level > 1 && is_stepped) return BodyKind::aggregate_of_stepped_bodies;
  if (level > 1) return has_squares ? BodyKind::aggregate_of_plates : BodyKind::aggregate_of_limbs;
  if (!has_squares) return BodyKind::limbs;
  if (is_flat(cells)) return BodyKind::flat_plate;
  if (is_stepped) return BodyKind::stepped;
  if (std::none_of(cells.begin(), cells.end(), [&](const CellIndex& cell) { return is_lowest(cell) && in_square(cell); }))
    return BodyKind::plate_on_legs;
  return std::all_of(cells.begin(), cells.end(), in_square) ? BodyKind::block : BodyKind::plate_with_limbs;
}

std::string_view to_string(BodyKind kind) { return names_of(kind).word; }
std::string_view name_of(BodyKind kind) { return names_of(kind).name; }
std::string_view plural_name(BodyKind kind) { return names_of(kind).plural; }

std::optional<BodyKind> body_kind(std::string_view name) {
  const auto found = std::find_if(body_kinds.begin(), body_kinds.end(), [&](BodyKind kind) { return to_string(kind) == name; });
  return found == body_kinds.end() ? std::nullopt : std::optional(*found);
}

}  // namespace menger::voxel
