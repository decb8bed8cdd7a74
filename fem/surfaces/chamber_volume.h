#pragma once

#include <array>
#include <cstddef>

#include "fem/surfaces/face.h"

namespace menger::fem {

/// Returns a face's share of the volume of the air that a chamber's surface encloses, m^3:
/// V = -1/3 int (x - origin) . (x_u x x_v) du dv, with the normal out of the solid, into the air.
///
/// The shares of a closed surface add up to the volume, for any origin. So do those of a surface that is closed by planes of
/// symmetry through the origin, because (x - origin) . n = 0 on such a plane. A single share has no meaning.
///
/// In each of u and v the integrand is a polynomial of degree 3 d - 1, with d the degree of the face: 2 or 5. Gauss's rule with d
/// + 1 points integrates it exactly. V is therefore a cubic form of the node positions with constant coefficients, exact to
/// rounding.
///
/// A chamber at the gauge pressure p does the virtual work p dV. Therefore p enters the residual of the equilibrium with -p dV/dx
/// and the tangent with -p d2V/dx2. Summed over a surface that is closed in one of the two ways, p dV/dx_a is the follower load
/// -p int N_a (x_u x x_v) du dv. Along a plane of symmetry this holds only for the components within the plane; those normal to
/// it are held. On a single face the two differ. The Hessian of V is symmetric on each face, while the tangent of the follower
/// load is symmetric only after assembly.
///
/// Defined for n = 4 and n = 9.
template <std::size_t n>
double chamber_volume(const FaceNodes<n>& nodes, const Point& origin = {});

/// Returns the gradient dV/dx, m^2: 3 n numbers, component i of node a at 3 a + i.
template <std::size_t n>
std::array<double, 3 * n> chamber_volume_gradient(const FaceNodes<n>& nodes, const Point& origin = {});

/// Returns the Hessian d2V/dx2, m: 3 n x 3 n numbers row by row, rows and columns as in the gradient. It is symmetric to the last
/// bit and not definite.
template <std::size_t n>
std::array<double, 9 * n * n> chamber_volume_hessian(const FaceNodes<n>& nodes, const Point& origin = {});

extern template double chamber_volume(const FaceNodes<4>&, const Point&);
extern template double chamber_volume(const FaceNodes<9>&, const Point&);
extern template std::array<double, 12> chamber_volume_gradient(const FaceNodes<4>&, const Point&);
extern template std::array<double, 27> chamber_volume_gradient(const FaceNodes<9>&, const Point&);
extern template std::array<double, 144> chamber_volume_hessian(const FaceNodes<4>&, const Point&);
extern template std::array<double, 729> chamber_volume_hessian(const FaceNodes<9>&, const Point&);

}  // namespace menger::fem
