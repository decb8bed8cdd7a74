#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "fem/pneumatics/pressure_schedule.h"

namespace menger::fem {

/// Coefficients of the generalised-alpha method for M u'' + S(u, u', t) = 0, S being all forces that resist:
///   M [(1 - am) a1 + am a0] + (1 - af) S1 + af S0 = 0,
///   u1 = u0 + h v0 + h^2 [(1/2 - b) a0 + b a1],  v1 = v0 + h [(1 - g) a0 + g a1].
/// Second order; unconditionally stable in linear problems; motion much faster than a step is damped by the factor rho in each,
/// slow motion as little as that allows. rho = 1 is the trapezoidal rule, which keeps the energy of linear problems.
/// @cite chung1993
struct GeneralisedAlpha {
  double alpha_m;
  double alpha_f;
  double beta;
  double gamma;
  /// c of the local error of displacements, c h^2 (a1 - a0) in leading order (1/12 for rho = 1, 1/3 for 0): what the expansion of
  /// u1 lacks in h^3, when a0 is u'' at the time t0 + (am - af) h.
  double error_constant;
};

/// @param spectral_radius rho in [0, 1], of motion that is much faster than a step
GeneralisedAlpha generalised_alpha(double spectral_radius);

/// The next step by the error of the last: factor 0.8 error^(-1/3), at least 0.2. Steps grow only by 1.5, where that is right: a
/// new factorisation has to be worth it.
/// @param error of the last step by the tolerance, >= 0; above 1 it has to be taken again
/// @param wanted_s what would have been taken if no end had been near, >= step_s: growth counts from there, as far as the error
/// of the shorter step allows
double next_step_s(double step_s, double error, double wanted_s);

/// The longest step that shows a schedule: a twentieth of a period, half a rise or a ramp or a line of a table. Nothing where the
/// pressure is constant.
std::optional<double> longest_step_s(std::span<const PlenumSchedule> schedules);

}  // namespace menger::fem
