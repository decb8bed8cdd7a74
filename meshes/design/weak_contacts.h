#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "meshes/design/polycube.h"

namespace menger::meshes {

/// Two cells that touch only along an edge or at a corner.
using WeakContact = std::pair<CellIndex, CellIndex>;

/// Returns the first pair of occupied cells, in grid order, with a weak contact: they share an edge or a corner, and no other
/// cell at that edge or corner joins them. Returns nothing if there is none. There a casting would be connected only along a line
/// or at a point, even if the cells are joined elsewhere.
std::optional<WeakContact> first_weak_contact(const Polycube& body);

/// Counts the pairs of cells that touch only along an edge and have no adjacent cell that joins both. Corners are not counted.
std::size_t count_edge_contacts(const Polycube& body);

/// Returns the position of a cell for messages: "(x, y, z)", counted from 0.
std::string cell_text(const CellIndex& cell);

}  // namespace menger::meshes
