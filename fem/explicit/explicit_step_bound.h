#pragma once

#include <span>
#include <vector>

#include "fem/contact/block_loop.h"
#include "fem/explicit/explicit_body.h"

namespace menger::fem {

/// Upper bounds of the largest eigenvalues of a body about a state: of M^-1 K, 1/s^2, and of M^-1 C, 1/s, with the tangent K, the
/// viscous matrix C and the lumped mass M.
struct EigenvalueBounds {
  double stiffness_per_s2 = 0.0;
  double damping_per_s = 0.0;
};

/// The bounds of a body at its displacements (3 per node, no element failed). They hold at this state only: as the body deforms,
/// its eigenvalues grow or fall.
///
/// K = K_rest + sum_e (U''_e / V_e) g_e g_e^T with the gradient g of an element's volume. The second part, which decides, has the
/// eigenvalues of the matrix s_e s_f g_e^T M^-1 g_f, s = sqrt(U'' / V), of pairs of elements; they are bounded by the largest
/// ratio (B w)_e / w_e of its absolute values B, for any positive w: after some power iterations. Masses are those of the
/// assembled nodes, so that a wall of one element gets its longer step. K_rest is at most the Frobenius norm of each element's
/// part at each of its nodes, C at most eta n V / h^2 with the shortest edge h and the largest n = |dev sym(G F^-1)|^2 of any
/// gradient G with |G| = 1 at a point: 2 eta n |G|^2 is what the point dissipates, and gradients of node velocities v have a mean
/// square of at most 4 / h^2 times that of v. A Maxwell branch, whose tensors stay as they are for a step, adds m n V / h^2 to K
/// with its modulus m and its own n (see ElementBounds). The largest sum of a node's shares over its mass bounds the eigenvalues.
///
/// The stiffness of follower pressure, smaller by about pressure over bulk modulus, is not in it.
/// @param branch tensors of all batches; empty: without branches
/// @param loop does the work on elements; the result does not depend on its threads
EigenvalueBounds eigenvalue_bounds(const ExplicitBody& body, std::span<const double> displacements_m,
                                   std::span<const double> branch = {}, const BlockLoop& loop = BlockLoop(1));

/// The largest step at which central differences with the damping force of the last half step stay stable: dt^2 k / 4 + dt c / 2
/// = 1 for the bounds k and c.
double stable_step_s(const EigenvalueBounds& bounds);

}  // namespace menger::fem
