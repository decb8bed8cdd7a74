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

/// How exactly air is integrated.
struct PneumaticAccuracy {
  double tolerance = 1e-9;                 ///< > 0, of a step's error in amounts of air, relative to them
  std::optional<double> largest_step_s{};  ///< > 0; none: a tenth of the shortest period of pistons and sources
  bool with_works = true;                  ///< otherwise those of states stay or are of no meaning
};

/// How an advance ended.
///
/// `completed`; `diverged`: a volume or its air is not positive; `not_converged`: the integrator found no step that keeps its
/// tolerance; `stopped`: the observer asked for it.
struct PneumaticReport {
  io::RunStatus status = io::RunStatus::completed;
  double time_s = 0.0;   ///< that was reached
  std::string reason{};  ///< empty if completed
};

/// Lets the air of a supply flow, by ARKODE of SUNDIALS: Kennedy and Carpenter's diagonally implicit Runge-Kutta rule of order 3
/// with an explicit first stage and three implicit ones, L-stable and exact at its end for lines of hardly any resistance, with
/// steps of its own under a tolerance. Lines without resistance are joined volumes (see PneumaticFlow). Works are integrated
/// along, see PneumaticWork.
///
/// It stops where the equations have a kink: at corners of schedules and ends of ramps, whose times are known; and by root
/// finding where the flow of a line turns turbulent or laminar. At points of a compliance's curve its steps become as short as
/// the tolerance asks.
///
/// Each advance begins anew: it depends on the state alone, so that a run can be resumed from a state with equal bytes. That is
/// why this is a one-step rule: the history of CVODE's formulas would belong to the state, and they would begin at order 1 with
/// each step of a walk. Air that leaves one volume enters another: amounts add up to rounding.
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

  /// Is told states on the way and says whether to go on.
  using Observer = std::function<bool(const PneumaticState&)>;

  /// Lets air flow until a later time, while the volumes change evenly to those given. The state stays as before where it is not
  /// completed.
  [[nodiscard]] PneumaticReport advance(PneumaticState& state, double time_s, std::span<const double> volumes_m3);

  /// The same for plena whose volume follows their pressure; nothing else moves them.
  /// @param observe is told the end of each step of the integrator, and the turning points of all plenum pressures, and for
  /// pistons of their pressure and of the drive of their lines; where it stops the advance, the state is the one that it was told
  /// last
  [[nodiscard]] PneumaticReport advance(PneumaticState& state, double time_s, std::span<const PlenumCompliance> plena,
                                        const Observer& observe = {});

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace menger::fem
