#pragma once

#include <array>
#include <vector>

#include "fem/surfaces/point.h"

namespace menger::fem {

/// The box of an element at rest: its lowest and its highest coordinates, m.
using ElementBox = std::array<Point, 2>;

/// Returns the depth y, in m, of the vertical plane along which a hollow body is cut open for a picture from the side of small y;
/// what lies in front of it, at smaller y, is taken away.
///
/// The plane opens at least half of the hollow area that any such plane opens, so none along a wall between chambers. Of these it
/// takes those that leave the most of the body's limbs, and of these the one next to the middle. A limb is a part of a layer of
/// the body, across x or z, that hangs together in this layer: it is lost if more than a little over half of its depth is taken
/// away.
/// @param elements boxes of all elements, at least one
double cutting_depth(const std::vector<ElementBox>& elements);

}  // namespace menger::fem
