#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "meshes/design/polycube.h"

namespace menger::meshes {

/// Two cells that touch only along an edge or at a corner.
using WeakContact = std::pair<CellIndex, CellIndex>;

/// The first pair of occupied cells, in grid order, that share an edge or a corner while no other cell at that edge or corner
/// joins them; nothing if there is none. A casting would hang on a line or a point there, whether or not the cells are joined
/// elsewhere.
std::optional<WeakContact> first_weak_contact(const Polycube& body);

/// Counts the pairs of cells that touch along an edge only, with no cell beside them that joins both. Corners are not counted.
std::size_t count_edge_contacts(const Polycube& body);

/// A cell as messages name it: "(x, y, z)", counted from 0.
std::string cell_text(const CellIndex& cell);

}  // namespace menger::meshes
