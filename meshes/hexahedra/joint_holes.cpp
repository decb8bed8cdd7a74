#include "meshes/hexahedra/joint_holes.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace menger::meshes {
namespace {

/// The pairs of cells through which two chambers touch; each pair is named by its lower cell.
using Contacts = std::map<std::tuple<std::size_t, std::size_t, Side>, std::vector<CellIndex>>;

Contacts side_by_side_contacts(const ModularBody& body, ChamberLayout layout) {
  Contacts contacts;
  for (const CellIndex& cell : body.cells().occupied()) {
    for (const Side side : {Side::x_max, Side::y_max}) {
      const CellIndex other = neighbour(cell, side);
      if (body.cells().at_or_empty(other) == empty || body.same_module(cell, other)) continue;
      if (layout == ChamberLayout::per_phase && body.cells().at(cell) != body.cells().at(other)) continue;
      contacts[{*body.region_of(cell), *body.region_of(other), side}].push_back(cell);
    }
  }
  return contacts;
}

/// Returns the cell nearest to the mean of all. It uses whole numbers (distances times the number of cells), so that equal
/// distances are equal on every machine.
CellIndex middle_cell(const std::vector<CellIndex>& cells) {
  const auto count = static_cast<long>(cells.size());
  std::array<long, 3> sum{};
  for (const CellIndex& cell : cells) sum = {sum[0] + cell.x, sum[1] + cell.y, sum[2] + cell.z};
  const auto distance = [&](const CellIndex& cell) {
    const std::array<long, 3> apart{count * cell.x - sum[0], count * cell.y - sum[1], count * cell.z - sum[2]};
    return apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2];
  };
  return *std::min_element(cells.begin(), cells.end(),
                           [&](const CellIndex& a, const CellIndex& b) { return distance(a) < distance(b); });
}

}  // namespace

std::vector<JointHole> joint_holes(const ModularBody& body, ChamberLayout layout) {
  std::vector<JointHole> holes;
  for (const auto& [contact, cells] : side_by_side_contacts(body, layout))
    holes.push_back({middle_cell(cells), std::get<Side>(contact)});
  return holes;
}

std::vector<std::size_t> plenums(const ModularBody& body, const std::vector<JointHole>& holes) {
  // Each plenum is a tree of chambers whose root is the smallest chamber.
  std::vector<std::size_t> parent(body.regions().size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t chamber) {
    while (parent[chamber] != chamber) chamber = parent[chamber] = parent[parent[chamber]];
    return chamber;
  };
  for (const JointHole& hole : holes) {
    const std::size_t a = root(*body.region_of(hole.cell));
    const std::size_t b = root(*body.region_of(neighbour(hole.cell, hole.side)));
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::size_t> plenum(parent.size());
  std::size_t count = 0;
  for (std::size_t chamber = 0; chamber < parent.size(); ++chamber)
    plenum[chamber] = root(chamber) == chamber ? count++ : plenum[root(chamber)];
  return plenum;
}

}  // namespace menger::meshes
