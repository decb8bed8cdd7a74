#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "meshes/load_cases/body_extents.h"

namespace menger::meshes {

/// How a body stands, by those of its points that lie in the six planes of its bounding box at rest: see rotation_of_body.
class OutermostPoints {
 public:
  /// @param at_rest_m the points of the body at rest, not in one plane, of which there is one at least; they are not kept
  explicit OutermostPoints(std::span<const std::array<double, 3>> at_rest_m);

  /// Returns the body's own upright axis: the direction into which the rotation of the body turns the vertical. Its length is 1.
  /// @param displacements_m 3 per point
  [[nodiscard]] std::array<double, 3> upright_axis(std::span<const double> displacements_m) const;

 private:
  std::array<std::array<std::vector<std::size_t>, 2>, 3> points_;  ///< of the ends: [axis][low, high]
  EndPoints at_rest_m_{};
};

}  // namespace menger::meshes
