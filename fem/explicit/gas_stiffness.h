#pragma once

#include <span>

#include "fem/explicit/explicit_body.h"
#include "fem/explicit/explicit_chambers.h"
#include "fem/pneumatics/pneumatic_supply.h"

namespace menger::fem {

/// Returns an upper bound of the square of the frequencies, 1/s^2, that air enclosed in plena adds to a body.
///
/// It is the largest over all plena of k sum_a |dV/dx_a|^2 / m_a with k = -dp/dV and lumped masses m. This is the one eigenvalue
/// of k M^-1 dV/dx dV/dx^T. Plena share no nodes, since there are walls between them. Held nodes count as if they were free.
/// @param displacements_m 3 per node
double gas_stiffness_per_s2(const ExplicitChambers& chambers, const ExplicitBody& body, std::span<const double> displacements_m,
                            const PneumaticSupply& supply, const PneumaticState& state);

}  // namespace menger::fem
