#pragma once

#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Returns how much faster bonds of solid voxels can damp than in a body of one density, >= 1.
///
/// Let d sqrt(E L) be the damping of a bond, m its lighter and R m its heavier end, omega^2 = E L / m. If all bonds of a body are
/// like this one, no motion is damped faster than at the rate 6 d sqrt(E L) (1 + 1/R) / m, because a voxel has at most six bonds.
/// Neighbours that move against each other in a full body have that rate. In a body of several kinds of bonds the fastest rate is
/// at most that of the kind with the largest one.
/// - With d = zeta sqrt(m) of each end by itself, rates are at most 12 zeta omega, at any R.
/// - With damping from velocities or balanced moments d is the mean of both ends, and the rate is 3 zeta omega (1 + sqrt R)
///   (1 + 1/R). It is more than 12 zeta omega from R = 3 + 2 sqrt 2 on.
///
/// The result is that rate over 12 zeta omega, and 1 where that is less.
double bond_rate_factor(const Physics& physics, double density_kg_m3, double other_density_kg_m3);

/// Returns the damping ratio that the bonds of solid voxels get in a step.
///
/// Let M, K and C be the matrices of mass, stiffness and damping, v the velocities and h the step.
/// - BondDamping::explicit_step damps by C v, with the rates before the step. It is stable as long as h^2 K + 2 h C < 4 M. In
///   full bodies C decides this limit.
/// - BondDamping::semi_implicit damps by C v / (1 + h r), where no rate of C is larger than r. For the motion that C damps
///   fastest this is backward Euler; all other motions get the same factor. No step makes the damping unstable, however strong it
///   is, and K may be half of what it may be without damping. Slower motions are damped too little, by that same factor, which
///   tends to 1 as the step gets smaller.
///
/// r = 12 zeta omega f: neighbours that move against each other stretch or shear six bonds at twice their speed, and each bond is
/// damped by zeta sqrt(m E L) along all axes. f is bond_rate_factor of the two materials: 1 where they have one density, and
/// taken for bodies of only one of the materials as well. With omega = sqrt(E L / m) and the recommended step 1 / (2 pi omega),
/// h omega is at most the fraction of that step over 2 pi. What remains of zeta is zeta / (1 + 6 f zeta fraction / pi).
/// @param physics without a surrogate, because the damping of a surrogate is one of its parameters
double effective_bond_ratio(const Physics& physics);

}  // namespace menger::voxel
