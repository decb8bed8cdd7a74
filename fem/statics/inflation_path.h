#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fem/statics/equilibrium.h"
#include "fem/statics/path_drives.h"

namespace menger::fem {

/// The results of one state on the path, given to the observer and kept in the report.
struct PathPoint {
  double s = 0.0;
  int step = 0;                           ///< 0: the state at rest under dead loads
  std::vector<double> pressures_Pa;       ///< gauge, per plenum
  std::vector<double> plenum_volumes_m3;  ///< of the modelled part
  std::vector<double> chamber_volumes_m3;
  std::vector<double> work_volumes_m3;  ///< per plenum, see BodyTotals
  double strain_energy_J = 0.0;
  double work_J = 0.0;  ///< work of the pressures since the start, sum of integral p dV (trapezoids)
  double dead_load_work_J = 0.0;
  double ground_force_N = 0.0;
  std::vector<PlateReaction> plates;  ///< on the body
  double smallest_ratio = 1.0;        ///< of the volume of any quadrature point to that at rest
  std::optional<int> negative_pivots;
  std::optional<double> smallest_gap_m;  ///< between facing chamber walls
  int iterations = 0;
  double seconds = 0.0;
};

/// A maximum or minimum of the pressure of a plenum as a function of its volume.
struct LimitPoint {
  std::size_t plenum = 0;
  double pressure_Pa = 0.0;  ///< gauge
  double volume_m3 = 0.0;
  bool passed = false;  ///< whether states beyond it were reached
};

/// Options of the steps along a path. The path parameter s runs from 0 to the number of legs; a leg lies between two knots.
struct PathOptions {
  double first_step = 0.25;      ///< of the path; of a leg
  double largest_step = 0.5;     ///< of a leg
  double smallest_step = 1e-4;   ///< of a leg; if a step as short as this fails, the path ends
  int desired_iterations = 6;    ///< steps grow when they take fewer, and shrink when they take more
  int predictor_order = 2;       ///< 0: the last state, 1: secant, 2: quadratic through the last three
  std::vector<double> stations;  ///< values of s to stop at exactly, in addition to the knots
  /// Walls touch when their gap is smaller than this times the chamber's size. 0: contact is not searched for.
  double touching_gap = 1e-3;
  /// Called after every step, and at a limit point that the path cannot pass; true ends the path there with status `completed`.
  /// May be empty.
  std::function<bool(const PathPoint& point, const std::vector<LimitPoint>& limit_points)> ends_at{};
};

struct PathReport {
  io::RunStatus status = io::RunStatus::completed;
  std::string reason;  ///< for the user: what was reached and why the path ended there
  std::vector<PathPoint> points;
  std::vector<LimitPoint> limit_points;
  int iterations = 0;
  int factorisations = 0;
  int rejected_steps = 0;
};

/// What a path needs to go on from where it was interrupted.
struct PathRestart {
  std::vector<double> s{};          ///< path parameters of `states`, oldest first
  std::vector<BodyState> states{};  ///< at most three, none from before the last knot: the next is extrapolated from them
  std::vector<PathPoint> points{};  ///< results of all states so far
  std::vector<LimitPoint> limit_points{};
  double next_step = 0.0;
  double failed_s = std::numeric_limits<double>::max();        ///< the smallest s that could not be reached
  io::RunStatus failed_status = io::RunStatus::not_converged;  ///< why it could not be reached
  std::string failure{};                                       ///< the same, for people
  int rejected_steps = 0;
};

/// Called with every new point and its state.
using PathObserver = std::function<void(const PathPoint& point, const BodyState& state, const PathRestart& restart)>;

/// Follows equilibria along the drives of plena and plates, with adaptive steps.
///
/// The path starts at rest, with the drives at their values at s = 0 (0 for pressures, 1 for ratios). Dead loads grow before
/// that, from s = -1 to 0. If there is a ground, they act in full from the start.
///
/// Stability (limit points under control by pressure) is checked where all plena are driven by pressure and the linear solver is
/// direct. With mixed drives a path that meets such a point ends as `not_converged`.
/// @param stop may be set on any rank at any time; the ranks agree on it between steps and iterations
/// @param restart from an earlier, interrupted run with the same body and drives
PathReport follow_path(Equilibrium& equilibrium, const PathDrives& drives, const PathOptions& options,
                       const PathObserver& observer, const std::atomic<bool>* stop = nullptr,
                       const PathRestart* restart = nullptr);

/// Follows a path on which all plates, if there are any, stay at rest.
PathReport follow_path(Equilibrium& equilibrium, const std::vector<PlenumDrive>& plena, const PathOptions& options,
                       const PathObserver& observer, const std::atomic<bool>* stop = nullptr,
                       const PathRestart* restart = nullptr);

}  // namespace menger::fem
