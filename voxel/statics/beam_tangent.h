#pragma once

#include <Eigen/Core>
#include <array>

#include "voxel/laws/beam.h"

namespace menger::voxel {

/// Position and orientation of a voxel, or of the place where a plate holds a voxel, in world axes.
struct Pose {
  Vector3<double> position{0.0, 0.0, 0.0};  ///< m
  Quaternion<double> orientation{1.0, 0.0, 0.0, 0.0};
};

/// Loads on the ends of a beam in world axes: force (N) and moment (N m) on the lower end, then on the upper end.
using EndLoads = Eigen::Matrix<double, 12, 1>;

/// The loads of a beam and their derivatives.
struct BeamTangent {
  EndLoads loads;
  /// Minus the derivative of the loads with respect to displacement (m) and world rotation vector (rad) of the lower end, then of
  /// the upper end. Not symmetric if the beam carries load.
  Eigen::Matrix<double, 12, 12> stiffness;
};

/// The ends of a beam along an axis between two poses, in the permuted axes of BeamEnds.
/// @param half_kink half the kink of the beam at rest, rad, see kink
BeamEnds<double> beam_ends(const Pose& lower, const Pose& upper, int axis, double rest_length_m,
                           const std::array<double, 2>& half_kink = {0.0, 0.0});

/// Loads of a beam in a given small-angle or large-angle state. @param small whether it is in the small-angle state @param axis
/// 0, 1 or 2: the beam's axis when undeformed
EndLoads beam_end_loads(const BeamEnds<double>& ends, bool small, const BeamCoefficients<double>& coefficients, int axis);

/// Loads of a beam and their derivatives at a fixed rest length.
///
/// Derivatives with respect to the separation and to the rotation of the upper end are central differences (relative error 1e-9).
/// Those with respect to the rotation of the lower end follow from them, because loads turn with the whole beam. @param length_m
/// scale of the difference steps: the voxel edge
BeamTangent beam_tangent(const BeamEnds<double>& ends, bool small, const BeamCoefficients<double>& coefficients, int axis,
                         double length_m);

}  // namespace menger::voxel
