#pragma once

#include "voxel/statics/responder.h"

namespace menger::voxel {

/// The surrogate's answer to a load case (see respond) and its derivatives by the theorem of implicit functions: with R the
/// residual of an equilibrium u and K = -dR/du its tangent, u changes by K^-1 dR, dR by differences of the residual at fixed u
/// between the parameters of a span; ordinates change with u and with the parameters, by differences between states so moved. It
/// takes one factorisation per state, whatever the number of spans, and agrees with differences of whole answers to the square
/// of the width of a span. Beams stay in the small- or large-angle state that they have in the equilibrium.
/// @param states rows of abscissae; empty: those of the load case
/// @throws std::invalid_argument if cell edge or wall thickness are not those of the parameters
ResponseSlopes respond_with_slopes(const SurrogateParameters& parameters, const meshes::LoadCase& load_case,
                                   const Responder::States& states, const std::vector<ParameterSpan>& spans);

/// Answers of the surrogate by its equilibria: respond and respond_with_slopes.
Responder equilibrium_responder();

}  // namespace menger::voxel
