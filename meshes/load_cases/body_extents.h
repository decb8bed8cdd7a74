#pragma once

#include <array>

namespace menger::meshes {

/// Mean positions of the end faces of a body in metres: [axis][low, high][coordinate]. The end faces of an axis are the faces
/// that lie in the two planes of the body's bounding box across it at rest.
using EndPoints = std::array<std::array<std::array<double, 3>, 2>, 3>;

/// How a body has turned between two states, from the middles of its six ends.
///
/// The rotation R (det R = 1, R[row][column]) is fitted together with stretches D = diag(d_x, d_y, d_z) along the body's axes:
/// sum_i |x_i - c - R D X_i|^2 -> min, with reference points X_i about their mean and deformed points x_i. Without the stretches
/// a longer body would seem to have turned a little, because the ends of an unsymmetric body do not lie on its axes.
///
/// A shear or a bend is not a stretch: what counts as rotation then is a mean over the body, and two models of a body agree in it
/// only as far as they agree in the six points. @param reference must have low != high along each axis.
///
/// Limits: where all six points lie on one line the turn about it is unknown, and arbitrary. For points that are near to that, it
/// is uncertain by their error over their distance from the line.
[[nodiscard]] std::array<std::array<double, 3>, 3> rotation_of_body(const EndPoints& reference, const EndPoints& deformed);

/// Distances of the ends along the axes in metres, [axis], after the rotation of the body is taken out:
///
///     extent_a = e_a . R^T (x_a,high - x_a,low).
///
/// They do not change under any rigid motion of the deformed points, and are exact for a stretch along the axes that is followed
/// by a rigid motion. Limits as for rotation_of_body; the result is finite in any case.
[[nodiscard]] std::array<double, 3> extents_without_rotation(const EndPoints& reference, const EndPoints& deformed);

}  // namespace menger::meshes
