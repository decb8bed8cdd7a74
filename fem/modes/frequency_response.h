#pragma once

#include <complex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fem/modes/linearised_body.h"
#include "fem/modes/vibration.h"

namespace menger::fem {

struct FrequencyResponseOptions {
  std::vector<double> frequencies_Hz;  ///< >= 0 (asserts)
  double loss_factor = 0.0;            ///< eta >= 0 (asserts) of structural damping, K (1 + i eta)
};

/// Steady motion under a harmonic load f exp(i omega t).
struct FrequencyResponse {
  /// completed, or not_converged where no static solution was found; otherwise the status of the modes
  io::RunStatus status = io::RunStatus::not_converged;
  std::string reason;  ///< why it is not completed, for the user
  /// By observable, then by frequency: the complex amplitude per unit of the load. The motion lags where the imaginary part is
  /// negative. There is no value where an undamped body is driven at a natural frequency (to within 1e-9 of it), because no
  /// steady motion is finite there, nor at or above the highest frequency among the modes.
  std::vector<std::vector<std::optional<std::complex<double>>>> amplitudes;
};

/// Returns the amplitudes of observables w . u, where (K (1 + i eta) - omega^2 M) u = f. It superposes modes x_k with lambda_k =
/// omega_k^2. Direct solutions add the contribution of all other modes. With A = K - s M, the body's shift s, z = omega^2 / (1 +
/// i eta), and P, which removes the given modes and the rigid motions,
///
/// u = 1/(1 + i eta) (sum_k x_k (x_k.f) / (lambda_k - z) + sum_m (z - s)^m (A^-1 M)^m P A^-1 f), m = 0, 1, 2.
///
/// The first of the last terms is the static correction. The error for each other mode, with its lambda_j, is about
/// ((omega^2 - s)/(lambda_j - s))^3 of its static share: small below half the highest frequency among the modes.
/// A load that moves the body rigidly (chamber pressure cannot) loses that part.
///
/// @param modes of the same body, completed
/// @param load force per local component, as LinearisedBody::volume_gradient returns it (per Pa); ghosts are not read
/// @param observables weights w per local component, the derivative of the observable by the displacements; ghosts are not read:
/// volume_gradient for a chamber's volume (m^3), 1 at one component for a displacement (m)
FrequencyResponse frequency_response(LinearisedBody& body, const VibrationReport& modes, std::span<const double> load,
                                     std::span<const std::vector<double>> observables, const FrequencyResponseOptions& options);

}  // namespace menger::fem
