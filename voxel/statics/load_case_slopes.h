#pragma once

#include "voxel/statics/responder.h"

namespace menger::voxel {

/// Computes the response of the surrogate to a load case (see respond) and its derivatives, by the implicit function theorem.
///
/// Let R be the residual of an equilibrium u, and K = -dR/du its tangent. Then u changes by K^-1 dR, where dR is the difference
/// of the residual at fixed u between the parameters of a span. Ordinates change with u and with the parameters; their changes
/// are differences between states moved in this way. This takes one factorisation per state for any number of spans. The results
/// agree with differences of whole responses to the square of the width of a span. Beams keep the small-angle or large-angle
/// state that they have in the equilibrium.
/// @param states rows of abscissae; empty: those of the load case
/// @throws std::invalid_argument if cell edge or wall thickness are not those of the parameters
ResponseSlopes respond_with_slopes(const SurrogateParameters& parameters, const meshes::LoadCase& load_case,
                                   const Responder::States& states, const std::vector<ParameterSpan>& spans);

/// The responder that computes equilibria of the surrogate: respond and respond_with_slopes.
Responder equilibrium_responder();

}  // namespace menger::voxel
