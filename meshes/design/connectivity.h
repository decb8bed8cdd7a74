#pragma once

#include <cstddef>

#include "meshes/design/polycube.h"

namespace menger::meshes {

/// Number of face-connected (6-connected) components of the occupied cells.
std::size_t count_components(const Polycube& body);

/// Whether the body is not empty and face-connected.
bool is_connected(const Polycube& body);

/// The body with only its largest face-connected component kept (materials unchanged); on a tie the component whose first cell in
/// grid order (x fastest, then y, then z) comes first. An empty body stays empty.
Polycube largest_component(const Polycube& body);

}  // namespace menger::meshes
