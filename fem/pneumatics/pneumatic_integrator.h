#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "fem/pneumatics/pneumatic_supply.h"
#include "fem/surfaces/plenum_compliance.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// The accuracy of the integration.
struct PneumaticAccuracy {
  double tolerance = 1e-9;                 ///< > 0; tolerated error of a step in amounts of air, relative to them
  std::optional<double> largest_step_s{};  ///< > 0; none: a tenth of the shortest period of pistons and sources
  bool with_works = true;                  ///< false: works in states are not updated or have no meaning
};

/// The outcome of an advance.
///
/// `completed`; `diverged`: a volume or its air is not positive; `not_converged`: the integrator found no step within its
/// tolerance; `stopped`: the observer returned false.
struct PneumaticReport {
  io::RunStatus status = io::RunStatus::completed;
  double time_s = 0.0;   ///< time that was reached
  std::string reason{};  ///< empty if completed
};

/// Integrates the flow of the air of a supply with ARKODE of SUNDIALS. The method is Kennedy and Carpenter's diagonally implicit
/// Runge-Kutta rule of order 3 with an explicit first stage and three implicit ones. It is L-stable and exact at its end for
/// lines of hardly any resistance. It chooses its own steps under a tolerance. Lines without resistance are joined volumes (see
/// PneumaticFlow). Works are integrated along with the air, see PneumaticWork.
///
/// It stops where the equations have a kink: at corners of schedules and ends of ramps, whose times are known, and where the flow
/// of a line becomes turbulent or laminar, which it finds by root finding. At points of a compliance's curve its steps become as
/// short as the tolerance requires.
///
/// Each advance starts anew and depends on the state alone, so a run can be resumed from a state with equal bytes. A one-step
/// rule is used for this reason: the history of CVODE's formulas would be part of the state, and they would start at order 1 with
/// each step of a walk. Air that leaves one volume enters another: amounts are conserved to rounding.
///
/// An object serves one thread at a time.
/// @cite reynolds2023arkode @cite hindmarsh2005sundials @cite kennedy2016diagonally
class PneumaticIntegrator {
 public:
  /// @throws std::bad_alloc
  explicit PneumaticIntegrator(const PneumaticSupply& supply, const PneumaticAccuracy& accuracy = {});
  ~PneumaticIntegrator();
  PneumaticIntegrator(PneumaticIntegrator&&) noexcept;
  PneumaticIntegrator& operator=(PneumaticIntegrator&&) noexcept;

  /// Called with states during an advance; returns whether to go on.
  using Observer = std::function<bool(const PneumaticState&)>;

  /// Advances the state to a later time while the volumes change evenly to the given ones. The state does not change unless the
  /// advance is completed.
  [[nodiscard]] PneumaticReport advance(PneumaticState& state, double time_s, std::span<const double> volumes_m3);

  /// Advances the state to a later time for plena whose volume follows their pressure; nothing else moves them.
  /// @param observe called at the end of each step of the integrator and at the turning points of all plenum pressures. With
  /// pistons it is also called at the turning points of their pressure and of the drive of their lines. If it stops the advance,
  /// the state is the last one it was called with.
  [[nodiscard]] PneumaticReport advance(PneumaticState& state, double time_s, std::span<const PlenumCompliance> plena,
                                        const Observer& observe = {});

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace menger::fem
