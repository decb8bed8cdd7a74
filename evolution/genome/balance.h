#pragma once

#include "meshes/design/polycube.h"

namespace menger::evolution {

/// Returns whether a body stands by itself: the centre of its cells lies above the inside of the convex hull of its lowest layer
/// of cells.
///
/// A body that does not stand falls over before it is driven, and a fall is not a step. All cells have equal weight here; the
/// walls of a hollow body may put its centre of mass slightly elsewhere.
bool is_balanced(const meshes::Polycube& body);

}  // namespace menger::evolution
