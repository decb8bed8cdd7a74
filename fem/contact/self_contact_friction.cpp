#include "fem/contact/self_contact_friction.h"

#include <cmath>
#include <cstddef>

namespace menger::fem {
namespace {

std::array<Point, 4> from_centre(const FaceCorners& corners) {
  const Point middle = centre(corners);
  std::array<Point, 4> arms;
  for (std::size_t c = 0; c < 4; ++c) arms[c] = difference(corners[c], middle);
  return arms;
}

/// The rotation w with sum r x (w x r) = m over the corners' arms r: that of four points of mass 1 with the angular momentum m.
/// It is zero where the corners lie on a line, because they have no inertia about it.
Point turn_of(const std::array<Point, 4>& arms, const Point& moment) {
  constexpr double smallest_inertia = 1e-9;  // ratio of the determinant to the cube of the trace; 1/54 for a square
  std::array<Point, 3> rows{};
  for (const Point& r : arms) {
    const double square = dot(r, r);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) rows[i][j] += (i == j ? square : 0.0) - r[i] * r[j];
  }
  const std::array<Point, 3> cofactors{cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])};
  const double determinant = dot(rows[0], cofactors[0]);
  const double trace = rows[0][0] + rows[1][1] + rows[2][2];
  if (!(determinant > smallest_inertia * trace * trace * trace)) return {};
  return scaled(1.0 / determinant,
                {dot(cofactors[0], moment), dot(cofactors[1], moment), dot(cofactors[2], moment)});  // a symmetric matrix
}

Point without_normal(const Point& vector, const Point& behind) {
  return difference(vector, scaled(dot(vector, behind) / dot(behind, behind), behind));
}

}  // namespace

Point face_turn_rad(const FaceCorners& corners, const std::array<Point, 4>& corner_displacements_m) {
  const std::array<Point, 4> arms = from_centre(corners);
  Point momentum{};
  for (std::size_t c = 0; c < 4; ++c) momentum = sum(momentum, cross(arms[c], corner_displacements_m[c]));
  return turn_of(arms, momentum);
}

Point path_along_face_m(const PressedNode& pressed, const Point& node_displacement_m,
                        const std::array<Point, 4>& corner_displacements_m) {
  Point of_face = cross(face_turn_rad(pressed.corners, corner_displacements_m), pressed.behind_m);
  for (std::size_t c = 0; c < 4; ++c) of_face = sum(of_face, scaled(pressed.weights[c], corner_displacements_m[c]));
  return without_normal(difference(node_displacement_m, of_face), pressed.behind_m);
}

Point friction_force_N(const SurfaceFriction& friction, const PressedNode& pressed, const Point& path_m, const Point& turn_rad,
                       double spring_N_per_m, ContactMemory& memory) {
  const double length = norm(memory.slip_m);
  Point slip = without_normal(sum(memory.slip_m, cross(turn_rad, memory.slip_m)), pressed.behind_m);
  if (const double turned = norm(slip); turned > 0.0) slip = scaled(length / turned, slip);
  slip = sum(slip, path_m);
  const double wanted = norm(slip);
  const double coefficient = memory.is_sliding ? friction.kinetic_coefficient : friction.static_coefficient;
  memory.is_sliding = wanted > coefficient * memory.pressed_m;
  if (memory.is_sliding) slip = scaled(friction.kinetic_coefficient * memory.pressed_m / wanted, slip);
  memory.slip_m = slip;
  return scaled(-spring_N_per_m, slip);
}

std::array<Point, 4> face_reactions_N(const PressedNode& pressed, const Point& force_N) {
  const std::array<Point, 4> arms = from_centre(pressed.corners);
  const Point turn = turn_of(arms, cross(pressed.behind_m, force_N));
  std::array<Point, 4> reactions;
  for (std::size_t c = 0; c < 4; ++c) reactions[c] = scaled(-1.0, sum(scaled(pressed.weights[c], force_N), cross(turn, arms[c])));
  return reactions;
}

}  // namespace menger::fem
