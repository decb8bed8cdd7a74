#pragma once

#include <array>
#include <cstddef>

#include "fem/surfaces/point.h"

namespace menger::fem {

/// Displacement components held at zero on all nodes of the faces with a label.
struct Support {
  std::size_t label;
  std::array<bool, 3> held;
};

/// Displacement components held at zero at the node nearest to a point of the reference configuration.
struct PointSupport {
  Point position;
  std::array<bool, 3> held;
};

}  // namespace menger::fem
