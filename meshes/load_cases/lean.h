#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace menger::meshes {

/// Returns the angle between two directions in degrees, 0 to 180; not a number if one of theirs is none. Accurate for small
/// angles and for those near 180 degrees, unlike the arc cosine of their product.
double angle_between_deg(const std::array<double, 3>& one, const std::array<double, 3>& other);

/// How far a body leans.
struct Lean {
  double angle_deg = 0.0;
  std::size_t period = 1;  ///< of the drive, at whose end it leans so, counted from 1
};

/// Returns the largest angle between the upright axis of a body at the end of a period of its drive and that at the end of the
/// first. At these times the drive is alike, so that a body that keeps its posture leans by 0, however it is deformed in between.
/// Turning about the vertical is no lean. The upright axis is the direction into which the rotation of the body
/// (rotation_of_body) turns the vertical.
/// @param upright_axes at the ends of the periods, from the first on
/// @return infinite, at the first such period, if an axis is not a number; 0 for fewer than two periods
Lean largest_lean(std::span<const std::array<double, 3>> upright_axes);

}  // namespace menger::meshes
