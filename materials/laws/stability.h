#pragma once

#include <optional>

#include "materials/laws/homogeneous_deformations.h"

namespace menger::materials {

/// Returns whether a law is stable after Drucker at a homogeneous deformation of an incompressible body: more strain always needs
/// more stress. The matrix d sigma_i / d ln(lambda_j), i, j = 1, 2, with sigma_3 = 0 is then positive definite. A law is not
/// stable where it is not valid.
/// @param stretches three positive numbers with product 1
bool is_drucker_stable(const HyperelasticLaw& law, const std::array<double, 3>& stretches);

/// Returns the first stretch from 1 to `end` at which a law is not stable in a mode, on a grid of 0.005; nothing if there is
/// none.
///
/// Tension and compression of different modes are the same deformation: equibiaxial tension to l is uniaxial compression to l^-2,
/// equibiaxial compression to l is uniaxial tension to l^-2, planar compression to l is planar tension to 1/l.
/// @param end positive; below 1 the search is in compression
std::optional<double> first_unstable_stretch(const HyperelasticLaw& law, LoadingMode mode, double end);

/// Returns the nominal stress in equibiaxial tension divided by that in uniaxial tension, at a stretch. Returns nothing if the
/// law is not valid there or the uniaxial stress is zero. Silicone has 1.1 to 1.7 at a stretch of 1.5. Laws fitted to tension
/// alone can be wrong by orders of magnitude.
std::optional<double> equibiaxial_ratio(const HyperelasticLaw& law, double stretch);

}  // namespace menger::materials
