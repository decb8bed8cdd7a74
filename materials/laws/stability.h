#pragma once

#include <optional>

#include "materials/laws/homogeneous_deformations.h"

namespace menger::materials {

/// Whether more strain always takes more stress (Drucker) at a homogeneous deformation of an incompressible body: the matrix
/// d sigma_i / d ln(lambda_j), i, j = 1, 2, with sigma_3 = 0 is positive definite. Where the law has no answer it is not stable.
/// @param stretches three positive numbers with product 1
bool is_drucker_stable(const HyperelasticLaw& law, const std::array<double, 3>& stretches);

/// The first stretch on the way from 1 to `end` at which a law is not stable in a mode, on a grid of 0.005; nothing if there is
/// none.
///
/// Tension and compression meet in the modes: equibiaxial tension to l is uniaxial compression to l^-2, equibiaxial compression
/// to l uniaxial tension to l^-2, planar compression to l planar tension to 1/l.
/// @param end positive; below 1 the way is one of compression
std::optional<double> first_unstable_stretch(const HyperelasticLaw& law, LoadingMode mode, double end);

/// Nominal stress in equibiaxial over that in uniaxial tension at a stretch; nothing where the law has no answer or no stress.
/// Silicone has 1.1 to 1.7 at a stretch of 1.5; laws fitted to tension alone can be off by orders of magnitude.
std::optional<double> equibiaxial_ratio(const HyperelasticLaw& law, double stretch);

}  // namespace menger::materials
