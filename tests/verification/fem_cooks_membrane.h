#pragma once

#include "fem_model.h"

namespace menger::fem {

/// Vertical deflection, mm, of the upper corner of the loaded end of Cook's membrane in plane strain: neo-Hookean, E = 240.565
/// MPa, nu = 0.4999 (mu = 80.2 MPa), a dead load of 100 N per mm of thickness on the end of 16 mm.
/// @param elements along each side
double cook_tip_mm(int degree, Formulation formulation, std::size_t elements);

/// Elguedj et al. (2008) on 128 x 128 elements, as quoted in FinEALE's example of the membrane.
inline constexpr double published_cook_tip_mm = 6.9083;

}  // namespace menger::fem
