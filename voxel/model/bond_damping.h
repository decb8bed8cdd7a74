#pragma once

#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Returns the damping ratio that the bonds of solid voxels get in a step.
///
/// Let M, K and C be the matrices of mass, stiffness and damping, v the velocities and h the step.
/// - BondDamping::explicit_step damps by C v, with the rates before the step. It is stable as long as h^2 K + 2 h C < 4 M. In
///   full bodies C decides this limit.
/// - BondDamping::semi_implicit damps by C v / (1 + h r), where r is the largest rate of C. For the motion that C damps fastest
///   this is backward Euler; all other motions get the same factor. No step makes the damping unstable, however strong it is, and
///   K may be half of what it may be without damping. Slower motions are damped too little, by that same factor, which tends to 1
///   as the step gets smaller.
///
/// r = 12 zeta omega: neighbours that move against each other stretch or shear six bonds at twice their speed, and each bond is
/// damped by zeta sqrt(m E L) along all axes. With omega = sqrt(E L / m) and the recommended step 1 / (2 pi omega), h omega is
/// the fraction of that step over 2 pi. What remains of zeta is zeta / (1 + 6 zeta fraction / pi). Bodies of two materials have
/// smaller rates.
/// @param physics without a surrogate, because the damping of a surrogate is one of its parameters
double effective_bond_ratio(const Physics& physics);

}  // namespace menger::voxel
