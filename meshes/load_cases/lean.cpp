#include "meshes/load_cases/lean.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace menger::meshes {

double angle_between_deg(const std::array<double, 3>& one, const std::array<double, 3>& other) {
  const std::array<double, 3> across{one[1] * other[2] - one[2] * other[1], one[2] * other[0] - one[0] * other[2],
                                     one[0] * other[1] - one[1] * other[0]};
  const double along = one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
  return 180.0 / std::numbers::pi * std::atan2(std::hypot(across[0], across[1], across[2]), along);
}

Lean largest_lean(std::span<const std::array<double, 3>> upright_axes) {
  Lean largest;
  for (std::size_t n = 1; n < upright_axes.size(); ++n) {
    // the heights of both axes would not tell a body that leans to the other side
    const double angle_deg = angle_between_deg(upright_axes.front(), upright_axes[n]);
    if (std::isnan(angle_deg)) return {std::numeric_limits<double>::infinity(), n + 1};
    if (angle_deg > largest.angle_deg) largest = {angle_deg, n + 1};
  }
  return largest;
}

}  // namespace menger::meshes
