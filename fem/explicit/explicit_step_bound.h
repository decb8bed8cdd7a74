#pragma once

#include <span>
#include <vector>

#include "fem/contact/block_loop.h"
#include "fem/explicit/explicit_body.h"

namespace menger::fem {

/// Upper bounds of the largest eigenvalues of a body about a state: of M^-1 K, 1/s^2, and of M^-1 C, 1/s. K is the tangent
/// stiffness, C the viscous matrix and M the lumped mass.
struct EigenvalueBounds {
  double stiffness_per_s2 = 0.0;
  double damping_per_s = 0.0;
};

/// Returns bounds of the eigenvalues of a body at given displacements (3 per node, no element failed). They hold only at this
/// state: eigenvalues grow or fall as the body deforms.
///
/// The stiffness is K = K_rest + sum_e (U''_e / V_e) g_e g_e^T with the gradient g of an element's volume.
///
/// The second part dominates. It has the eigenvalues of the matrix s_e s_f g_e^T M^-1 g_f of pairs of elements, where s =
/// sqrt(U'' / V). They are bounded by the largest ratio (B w)_e / w_e of the matrix B of its absolute values, for any positive w.
/// Some power iterations choose w. Masses are those of the assembled nodes, so that a wall of one element gets the longer step
/// that it allows.
///
/// K_rest is bounded at each node by the Frobenius norm of each element's part. C is bounded by eta n V / h^2 with the shortest
/// edge h and the largest n = |dev sym(G F^-1)|^2 of any gradient G with |G| = 1 at a point: a point dissipates 2 eta n |G|^2,
/// and gradients of nodal velocities v have a mean square of at most 4 / h^2 times that of v. A Maxwell branch, whose tensors are
/// constant during a step, adds m n V / h^2 to K with its modulus m and its own n (see ElementBounds). The largest sum of a
/// node's shares over its mass bounds the eigenvalues.
///
/// The stiffness of follower pressure is not included. It is smaller by about pressure over bulk modulus.
/// @param branch tensors of all batches; empty: without branches
/// @param loop distributes the work on elements; the result does not depend on its threads
EigenvalueBounds eigenvalue_bounds(const ExplicitBody& body, std::span<const double> displacements_m,
                                   std::span<const double> branch = {}, const BlockLoop& loop = BlockLoop(1));

/// Returns the largest step at which central differences, with the damping force of the last half step, are stable: dt^2 k / 4 +
/// dt c / 2 = 1 for the bounds k and c.
double stable_step_s(const EigenvalueBounds& bounds);

}  // namespace menger::fem
