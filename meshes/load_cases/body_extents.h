#pragma once

#include <array>

namespace menger::meshes {

/// The mean positions of the end faces of a body in metres: [axis][low, high][coordinate]. The end faces of an axis are the faces
/// that, at rest, lie in the two planes of the body's bounding box perpendicular to it.
using EndPoints = std::array<std::array<std::array<double, 3>, 2>, 3>;

/// Returns the rotation of a body between two states, computed from the mean positions of its six ends.
///
/// The rotation R (det R = 1, R[row][column]) is fitted together with stretches D = diag(d_x, d_y, d_z) along the body's axes:
/// sum_i |x_i - c - R D X_i|^2 -> min, with reference points X_i about their mean and deformed points x_i. Without the stretches,
/// a body that becomes longer would seem to turn a little, because the ends of an unsymmetric body do not lie on its axes.
///
/// A shear or a bend is not a stretch. In such a deformation the rotation is a mean over the body, and two models of a body agree
/// in it only as far as they agree in the six points.
/// @param reference must have low != high along each axis
///
/// Limits: if all six points lie on one line, the rotation about this line is unknown and arbitrary. For points close to one
/// line, its uncertainty is their error divided by their distance from the line.
[[nodiscard]] std::array<std::array<double, 3>, 3> rotation_of_body(const EndPoints& reference, const EndPoints& deformed);

/// Returns the distances of the ends along the axes in metres, [axis], after the rotation of the body is removed:
///
///     extent_a = e_a . R^T (x_a,high - x_a,low).
///
/// They do not change under a rigid motion of the deformed points. They are exact for a stretch along the axes followed by a
/// rigid motion. Limits are those of rotation_of_body; the result is always finite.
[[nodiscard]] std::array<double, 3> extents_without_rotation(const EndPoints& reference, const EndPoints& deformed);

}  // namespace menger::meshes
