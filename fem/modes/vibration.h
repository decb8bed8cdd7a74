#pragma once

#include <string>
#include <vector>

#include "fem/modes/linearised_body.h"
#include "io/text/run_status.h"

namespace menger::fem {

struct VibrationOptions {
  int mode_count = 6;                 ///< > 0 (asserts); fewer are found where the body has fewer
  double relative_tolerance = 1e-10;  ///< tolerance of the residual of K x = omega^2 M x
};

/// The natural frequencies of a body about a state, the lowest first. Rigid motions are not among them.
struct VibrationReport {
  /// completed; limit_point: the state is unstable, and small motions grow instead of vibrating; not_converged
  io::RunStatus status = io::RunStatus::not_converged;
  std::string reason;                      ///< why it is not completed, for the user
  std::vector<double> frequencies_Hz;      ///< ascending, > 0; empty unless completed
  std::vector<std::vector<double>> modes;  ///< mode of each frequency: 3 per local node, ghosts up to date, x^T M x = 1 kg m^2
  int rigid_modes = 0;                     ///< motions without energy that were left out, 0 to 6
};

/// Solves K x = omega^2 M x with SLEPc's Krylov-Schur method on (K - shift M)^-1 M, in the inner product of M, with the rigid
/// motions deflated.
///
/// The sign of a mode is chosen so that its component of largest size is positive. For a frequency that occurs more than once, as
/// in symmetric bodies, the result is any orthonormal basis of its modes. Two effects are left out. Damping would shift
/// frequencies of silicone by a relative amount of about loss factor^2 / 8. The compression of gas in closed chambers would make
/// them stiffer; here pressures are constant. Works on any number of ranks; collective.
VibrationReport vibrations(LinearisedBody& body, const VibrationOptions& options = {});

/// Computes the vibrations about a state of an equilibrium.
VibrationReport vibrations(Equilibrium& equilibrium, const BodyState& state, double dead_load_factor = 1.0,
                           const VibrationOptions& options = {});

}  // namespace menger::fem
