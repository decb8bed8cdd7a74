#pragma once

#include <cstddef>

#include "meshes/design/polycube.h"

namespace menger::meshes {

/// Returns the number of face-connected (6-connected) components of the occupied cells.
std::size_t count_components(const Polycube& body);

/// Returns whether the body is not empty and face-connected.
bool is_connected(const Polycube& body);

/// Returns the body with only its largest face-connected component (materials unchanged). If two are equally large, it keeps the
/// one whose first cell comes first in grid order (x fastest, then y, then z). An empty body stays empty.
Polycube largest_component(const Polycube& body);

}  // namespace menger::meshes
