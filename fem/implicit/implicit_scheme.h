#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "fem/pneumatics/pressure_schedule.h"

namespace menger::fem {

/// Coefficients of the generalised-alpha method for M u'' + S(u, u', t) = 0, where S is the sum of all resisting forces:
///   M [(1 - am) a1 + am a0] + (1 - af) S1 + af S0 = 0,
///   u1 = u0 + h v0 + h^2 [(1/2 - b) a0 + b a1],  v1 = v0 + h [(1 - g) a0 + g a1].
/// The method is of second order and unconditionally stable in linear problems. It damps motion much faster than a step by the
/// factor rho in each step, and slow motion as little as that allows. rho = 1 is the trapezoidal rule, which conserves the energy
/// of linear problems.
/// @cite chung1993
struct GeneralisedAlpha {
  double alpha_m;
  double alpha_f;
  double beta;
  double gamma;
  /// The constant c of the local error of displacements, c h^2 (a1 - a0) in leading order (1/12 for rho = 1, 1/3 for 0). This is
  /// the h^3 term that is missing in the expansion of u1, if a0 is u'' at the time t0 + (am - af) h.
  double error_constant;
};

/// Returns the coefficients of the method.
/// @param spectral_radius rho in [0, 1], for motion much faster than a step
GeneralisedAlpha generalised_alpha(double spectral_radius);

/// Returns the length of the next step from the error of the last one: the factor is 0.8 error^(-1/3), at least 0.2. Steps grow
/// only by a factor of 1.5, and only if the error allows that much, because each new length needs a new factorisation.
/// @param error of the last step over the tolerance, >= 0; above 1 the step has to be repeated
/// @param wanted_s step that would have been taken if no end time had been near, >= step_s; growth is relative to it, as far as
/// the error of the shorter step allows
double next_step_s(double step_s, double error, double wanted_s);

/// Returns the longest step that resolves the schedules: a twentieth of a period, half a rise or a ramp, or half the time between
/// two rows of a table. Empty if the pressure is constant.
std::optional<double> longest_step_s(std::span<const PlenumSchedule> schedules);

}  // namespace menger::fem
