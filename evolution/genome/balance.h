#pragma once

#include "meshes/design/polycube.h"

namespace menger::evolution {

/// Whether a body stands by itself: the centre of its cells lies above the inside of the convex hull of its lowest layer of
/// cells. One that does not falls over before anything drives it, and a fall is no step. Cells count alike: the walls of a hollow
/// body may move its centre a little from there.
bool is_balanced(const meshes::Polycube& body);

}  // namespace menger::evolution
