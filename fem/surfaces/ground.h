#pragma once

#include <array>
#include <cstddef>

#include "fem/surfaces/face.h"

namespace menger::fem {

/// A plane z = z0. Points of the body below it are pushed up in proportion to their depth.
struct GroundPlane {
  double height_m = 0.0;            ///< z0
  double stiffness_Pa_per_m = 1e7;  ///< eps > 0: pressure divided by depth; under a pressure q the depth is q / eps
};

/// Returns the energy of a face in the ground, J: E = eps/2 int <z0 - z>^2 dA over the face's area in the reference
/// configuration, with <s> = max(s, 0). There is no friction.
///
/// The integral uses Gauss's rule with degree + 2 points in each direction. It is exact for a parallelogram with all points of
/// the rule below the plane. Where the edge of contact crosses the face, the integrand has a kink, and the error decreases with
/// the size of the face. Gradient and Hessian are those of the computed sum, so they agree with it to rounding. The Hessian jumps
/// where a point of the rule touches down.
///
/// Defined for n = 4 and n = 9. @param reference node positions that give the area @param current node positions
template <std::size_t n>
double ground_energy_J(const GroundPlane& ground, const FaceNodes<n>& reference, const FaceNodes<n>& current);

/// Returns the gradient dE/dz, N: one number per node, never positive for bilinear faces. Derivatives by x and y are zero. The
/// ground's force on the face is upwards and equals minus the sum of the gradient.
template <std::size_t n>
std::array<double, n> ground_gradient_N(const GroundPlane& ground, const FaceNodes<n>& reference, const FaceNodes<n>& current);

/// Returns the Hessian d2E/dz2, N/m: n x n numbers row by row, symmetric and positive semidefinite.
template <std::size_t n>
std::array<double, n * n> ground_hessian(const GroundPlane& ground, const FaceNodes<n>& reference, const FaceNodes<n>& current);

/// Returns the ground's force on the face, N, upwards positive: eps int <z0 - z> dA.
template <std::size_t n>
double ground_force_N(const GroundPlane& ground, const FaceNodes<n>& reference, const FaceNodes<n>& current);

extern template double ground_energy_J(const GroundPlane&, const FaceNodes<4>&, const FaceNodes<4>&);
extern template double ground_energy_J(const GroundPlane&, const FaceNodes<9>&, const FaceNodes<9>&);
extern template std::array<double, 4> ground_gradient_N(const GroundPlane&, const FaceNodes<4>&, const FaceNodes<4>&);
extern template std::array<double, 9> ground_gradient_N(const GroundPlane&, const FaceNodes<9>&, const FaceNodes<9>&);
extern template std::array<double, 16> ground_hessian(const GroundPlane&, const FaceNodes<4>&, const FaceNodes<4>&);
extern template std::array<double, 81> ground_hessian(const GroundPlane&, const FaceNodes<9>&, const FaceNodes<9>&);
extern template double ground_force_N(const GroundPlane&, const FaceNodes<4>&, const FaceNodes<4>&);
extern template double ground_force_N(const GroundPlane&, const FaceNodes<9>&, const FaceNodes<9>&);

}  // namespace menger::fem
