#pragma once

#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Damping ratio that the bonds of solid voxels get in a step.
///
/// BondDamping::explicit_step damps by the rates before the step, C v: stable as long as h^2 K + 2 h C < 4 M, which C decides in
/// full bodies. BondDamping::semi_implicit damps by C v / (1 + h r), where r is the largest rate of C: what backward Euler makes
/// of the motion that C damps fastest, for all motions alike. No step makes that unstable, whatever the damping, and K may be
/// half of what it may be without damping; slower motions are damped too little, by the factor too, which tends to 1 with the
/// step.
///
/// r = 12 zeta omega: neighbours that move against each other stretch or shear six bonds at twice their speed, each damped by
/// zeta sqrt(m E L) along all axes. With omega = sqrt(E L / m) of the recommended step 1 / (2 pi omega), h omega is the fraction
/// of it over 2 pi, and what remains of zeta is zeta / (1 + 6 zeta fraction / pi). Two materials have smaller rates.
/// @param physics without a surrogate, whose damping is part of its parameters
double effective_bond_ratio(const Physics& physics);

}  // namespace menger::voxel
