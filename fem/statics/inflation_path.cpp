#include "fem/statics/inflation_path.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>

#include "fem/statics/chamber_gap.h"
#include "fem/statics/limit_point.h"
#include "fem/statics/state_predictor.h"

namespace menger::fem {

namespace {

using Clock = std::chrono::steady_clock;

/// Below this volume ratio at a quadrature point, an element is too coarse for its strain.
constexpr double collapsing_ratio = 0.5;

/// If no further step is found, an extrapolated limit point that is this near (relative to the pressure) counts as the cause.
constexpr double near_limit = 0.02;

/// Number of solutions that bring a limit point from the parabola through three steps of the path to about 1e-6 of its pressure.
constexpr int limit_point_passes = 3;

/// A path under control by pressure ends this near to a limit point, relative to its pressure. The volume then still differs from
/// that of the limit point by a few per cent.
constexpr double close_to_limit = 5e-4;

class PathFollower {
 public:
  PathFollower(Equilibrium& equilibrium, const PathDrives& drives, const PathOptions& options, const PathObserver& observer,
               const std::atomic<bool>* stop);

  PathReport follow(const PathRestart* restart);

 private:
  enum class StepOutcome { accepted, rejected, ended };

  void begin();
  void resume(const PathRestart& restart);
  StepOutcome try_step(double s);
  EquilibriumReport solve_at(double s, BodyState& state, int order);
  bool is_unstable(const BodyState& state, double s, EquilibriumReport& report);
  [[nodiscard]] bool moved_past_gap(const BodyState& state) const;
  [[nodiscard]] bool any_chamber_shrinks(const BodyState& state, const BodyTotals& totals) const;
  StepOutcome reject(io::RunStatus status, std::string reason);
  bool accept(double s, const BodyState& state, const EquilibriumReport& report, std::optional<WallGap> gap);
  void note_limit_points();
  LimitPoint refined(LimitPoint found, std::array<PathPoint, 3> around);
  [[nodiscard]] std::optional<LimitPoint> nearest_limit() const;
  [[nodiscard]] bool is_barrier_ahead() const;
  bool shorten_step(double target);
  void end_at_smallest_step();
  void end(io::RunStatus status, std::string reason);

  Equilibrium& equilibrium_;
  const PathDrives& drives_;
  PathSchedule schedule_;
  const PathOptions& options_;
  const PathObserver& observer_;
  const std::atomic<bool>* stop_;
  ChamberGaps gaps_;
  StatePredictor history_;
  std::vector<double> rest_volumes_m3_;  ///< of the plena
  std::vector<double> rest_chamber_volumes_m3_;
  double step_ = 0.0;
  double failed_s_ = std::numeric_limits<double>::max();  ///< the smallest s that could not be reached
  std::optional<double> last_gap_m_;
  std::string failure_;  ///< why the last rejected step was rejected
  io::RunStatus failed_status_ = io::RunStatus::not_converged;
  PathReport report_;
  Clock::time_point step_started_ = Clock::now();
};

PathFollower::PathFollower(Equilibrium& equilibrium, const PathDrives& drives, const PathOptions& options,
                           const PathObserver& observer, const std::atomic<bool>* stop)
    : equilibrium_(equilibrium),
      drives_(drives),
      schedule_(drives),
      options_(options),
      observer_(observer),
      stop_(stop),
      gaps_(equilibrium.space(), equilibrium.body()),
      history_(options.predictor_order),
      step_(options.first_step) {
  assert(drives.plena.size() == equilibrium.body().plenum_count);
  assert(drives.plates.empty() || drives.plates.size() == equilibrium.body().plates.size());
  const BodyTotals at_rest = equilibrium.totals(equilibrium.rest());
  rest_volumes_m3_ = equilibrium.plenum_volumes(at_rest);
  rest_chamber_volumes_m3_ = at_rest.chamber_volumes_m3;
}

EquilibriumReport PathFollower::solve_at(double s, BodyState& state, int order) {
  state = history_.at(s, order);
  const std::vector<PlenumControl> controls = schedule_.controls_at(s, rest_volumes_m3_);
  equilibrium_.move_plates(schedule_.plate_motions_at(s, equilibrium_.body().plates.size()));
  // Without extrapolation the body is still in equilibrium with the old pressures.
  const std::vector<double> old = history_.last().plenum_pressures_Pa;
  EquilibriumReport report = equilibrium_.solve(state, controls, schedule_.dead_load_factor_at(s),
                                                order == 0 ? std::span<const double>(old) : std::span<const double>(), stop_);
  report_.iterations += report.iterations;
  report_.factorisations += report.factorisations;
  return report;
}

/// Whether an equilibrium at given pressures lies beyond a limit or bifurcation point. The factorisation during the search may be
/// that of a state before it. Negative pivots are confirmed by a factorisation at the state itself; so is that there are none at
/// knots and stations, and where the search needed no factorisation. Iterative solvers tell nothing.
bool PathFollower::is_unstable(const BodyState& state, double s, EquilibriumReport& report) {
  if (equilibrium_.linear_choice().method != LinearMethod::direct) return false;
  if (report.negative_pivots == 0 && !is_knot_or_station(s, options_.stations)) return false;
  ++report_.factorisations;
  report.negative_pivots = equilibrium_.count_negative_pivots(state, schedule_.dead_load_factor_at(s));
  return report.negative_pivots.value_or(0) > 0;
}

/// Whether walls could have crossed unseen since the last state: twice the largest displacement is more than the gap plus the
/// depth up to which a crossing is recognised.
bool PathFollower::moved_past_gap(const BodyState& state) const {
  if (!last_gap_m_) return false;
  double largest = 0.0;
  const std::vector<double>& before = history_.last().displacements_m;
  for (std::size_t n = 0; n < before.size(); n += 3) {
    double square = 0.0;
    for (std::size_t i = 0; i < 3; ++i) square += std::pow(state.displacements_m[n + i] - before[n + i], 2);
    largest = std::max(largest, square);
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, equilibrium_.space().communicator);
  return 2.0 * std::sqrt(largest) > *last_gap_m_ + gaps_.recognised_depth_m();
}

/// Whether walls of a chamber may be nearer to each other than at rest.
bool PathFollower::any_chamber_shrinks(const BodyState& state, const BodyTotals& totals) const {
  for (const double pressure_Pa : state.plenum_pressures_Pa)
    if (pressure_Pa < 0.0) return true;
  for (std::size_t c = 0; c < totals.chamber_volumes_m3.size(); ++c)
    if (totals.chamber_volumes_m3[c] < 0.999 * rest_chamber_volumes_m3_[c]) return true;
  return false;
}

PathFollower::StepOutcome PathFollower::reject(io::RunStatus status, std::string reason) {
  failed_status_ = status;
  failure_ = std::move(reason);
  return StepOutcome::rejected;
}

PathFollower::StepOutcome PathFollower::try_step(double s) {
  BodyState state;
  EquilibriumReport report = solve_at(s, state, history_.present_order());
  if (report.status == io::RunStatus::inverted_element && history_.present_order() > 0) report = solve_at(s, state, 0);
  if (report.status == io::RunStatus::stopped) {
    end(io::RunStatus::stopped, "stopped by the user");
    return StepOutcome::ended;
  }
  if (report.status != io::RunStatus::completed) {
    return reject(report.status, report.reason);
  }
  if (schedule_.all_given_pressures() && is_unstable(state, s, report)) {
    return reject(io::RunStatus::limit_point, "the equilibrium is unstable");
  }
  std::optional<WallGap> gap;
  if (options_.touching_gap > 0.0 && any_chamber_shrinks(state, report.totals)) {
    if (!last_gap_m_) {
      const auto before = gaps_.smallest(history_.last().displacements_m);
      if (before) last_gap_m_ = before->gap_m;
    }
    gap = gaps_.smallest(state.displacements_m);
    if (gap && gap->is_crossing) return reject(io::RunStatus::wall_contact, "chamber walls would cross");
    if (gap && moved_past_gap(state))
      return reject(io::RunStatus::not_converged, "chamber walls move too far to find out whether they cross");
  }
  return accept(s, state, report, gap) ? StepOutcome::accepted : StepOutcome::ended;
}

/// @return whether the path goes on
bool PathFollower::accept(double s, const BodyState& state, const EquilibriumReport& report, std::optional<WallGap> gap) {
  PathPoint point;
  point.s = s;
  point.step = static_cast<int>(report_.points.size());
  point.pressures_Pa = state.plenum_pressures_Pa;
  point.plenum_volumes_m3 = report.plenum_volumes_m3;
  point.chamber_volumes_m3 = report.totals.chamber_volumes_m3;
  point.work_volumes_m3 = report.totals.work_volumes_m3;
  point.strain_energy_J = report.totals.strain_energy_J;
  point.dead_load_work_J = report.totals.dead_load_work_J;
  point.ground_force_N = report.totals.ground_force_N;
  point.plates = report.totals.plates;
  point.smallest_ratio = report.totals.smallest_ratio;
  point.negative_pivots = report.negative_pivots;
  point.iterations = report.iterations;
  if (gap) point.smallest_gap_m = gap->gap_m;
  last_gap_m_ = point.smallest_gap_m;
  if (!report_.points.empty()) {
    const PathPoint& before = report_.points.back();
    point.work_J = before.work_J;
    for (std::size_t p = 0; p < drives_.plena.size(); ++p) {
      point.work_J +=
          0.5 * (before.pressures_Pa[p] + point.pressures_Pa[p]) * (point.work_volumes_m3[p] - before.work_volumes_m3[p]);
    }
  }
  point.seconds = std::chrono::duration<double>(Clock::now() - step_started_).count();
  step_started_ = Clock::now();
  // A knot is a corner of the path, so nothing is extrapolated across it.
  if (!history_.path_parameters().empty() && is_knot(s)) {
    history_.clear();
    failed_s_ = std::numeric_limits<double>::max();
    failed_status_ = io::RunStatus::not_converged;
  }
  history_.add(s, state);
  report_.points.push_back(point);
  note_limit_points();
  if (point.step > 0) {
    const double length = s - report_.points[report_.points.size() - 2].s;
    const double factor = std::clamp(static_cast<double>(options_.desired_iterations) / std::max(point.iterations, 1), 0.5, 2.0);
    step_ = std::min(options_.largest_step, std::max(step_, length) * factor);
  }
  if (observer_) {
    observer_(point, state,
              {history_.path_parameters(), history_.states(), report_.points, report_.limit_points, step_, failed_s_,
               failed_status_, failure_, report_.rejected_steps});
  }
  if (gap && gap->gap_m <= options_.touching_gap * gaps_.size_m()) {
    end(io::RunStatus::wall_contact, "two walls of a chamber touch");
    return false;
  }
  return true;
}

/// Adds a limit point where the pressure of a plenum under control by volume or gas has passed an extremum.
void PathFollower::note_limit_points() {
  const std::size_t count = report_.points.size();
  // At a knot and under growing dead loads the pressure may turn for other reasons.
  if (count < 3 || report_.points[count - 3].s < 0.0 || is_knot(report_.points[count - 2].s)) return;
  for (std::size_t p = 0; p < drives_.plena.size(); ++p) {
    if (schedule_.is_given_pressure(p) || !schedule_.is_driven(p, report_.points[count - 2].s)) continue;
    const std::array<PathPoint, 3> around{report_.points[count - 3], report_.points[count - 2], report_.points[count - 1]};
    const auto extremum = pressure_extremum(around[0], around[1], around[2], p);
    if (extremum) report_.limit_points.push_back(refined(*extremum, around));
  }
}

/// Improves a limit point: solves for the state at the volume of the extremum, and again with the parabola through the three
/// nearest states.
LimitPoint PathFollower::refined(LimitPoint found, std::array<PathPoint, 3> around) {
  const std::size_t p = found.plenum;
  for (int pass = 0; pass < limit_point_passes; ++pass) {
    // s and V are nearly proportional between neighbouring states
    const std::size_t side =
        (found.volume_m3 > around[1].plenum_volumes_m3[p]) == (around[2].plenum_volumes_m3[p] > around[1].plenum_volumes_m3[p])
            ? 1
            : 0;
    const PathPoint& from = around[side];
    const PathPoint& to = around[side + 1];
    const double part = (found.volume_m3 - from.plenum_volumes_m3[p]) / (to.plenum_volumes_m3[p] - from.plenum_volumes_m3[p]);
    const double s = from.s + part * (to.s - from.s);
    if (std::min({std::abs(s - around[0].s), std::abs(s - around[1].s), std::abs(s - around[2].s)}) < 1e-9) break;
    BodyState state;
    const EquilibriumReport report = solve_at(s, state, history_.present_order());
    if (report.status != io::RunStatus::completed) break;
    PathPoint point;
    point.s = s;
    point.pressures_Pa = state.plenum_pressures_Pa;
    point.plenum_volumes_m3 = report.plenum_volumes_m3;
    // of the four states in order keep the three around the highest (or lowest)
    std::vector<PathPoint> four(around.begin(), around.end());
    four.insert(four.begin() + static_cast<std::ptrdiff_t>(side) + 1, point);
    const auto first = pressure_extremum(four[0], four[1], four[2], p);
    const auto second = pressure_extremum(four[1], four[2], four[3], p);
    if (!first && !second) break;
    const std::size_t begin = first ? 0 : 1;
    around = {four[begin], four[begin + 1], four[begin + 2]};
    found = first ? *first : *second;
  }
  return found;
}

void PathFollower::end(io::RunStatus status, std::string reason) {
  report_.status = status;
  report_.reason = std::move(reason);
}

/// Returns the limit point that the last three states approach under control by pressure. Of several plena it takes the one that
/// is relatively nearest to its own.
std::optional<LimitPoint> PathFollower::nearest_limit() const {
  const std::size_t count = report_.points.size();
  if (count < 3 || !schedule_.all_given_pressures()) return std::nullopt;
  std::optional<LimitPoint> nearest;
  double least = 0.0;
  for (std::size_t p = 0; p < drives_.plena.size(); ++p) {
    // States of a leg on which the pressure of this plenum was constant do not belong to this curve.
    if (!schedule_.is_driven(p, report_.points[count - 3].s) || !schedule_.is_driven(p, report_.points.back().s)) continue;
    const auto limit = extrapolated_limit(report_.points[count - 3], report_.points[count - 2], report_.points[count - 1], p);
    if (!limit) continue;
    const double ahead = std::abs(limit->pressure_Pa / report_.points.back().pressures_Pa[p] - 1.0);
    if (!nearest || ahead < least) {
      nearest = limit;
      least = ahead;
    }
  }
  return nearest;
}

/// Whether the cause of the last rejected step still lies ahead of a shorter step from a nearer state: a limit point or walls
/// that touch, but not a search that merely failed.
bool PathFollower::is_barrier_ahead() const {
  return failed_status_ == io::RunStatus::limit_point || failed_status_ == io::RunStatus::wall_contact ||
         nearest_limit().has_value();
}

/// Shortens the step after a rejected one to half of it, or to less where the states approach a limit point, but to no less than
/// a tenth.
/// @return whether another step can be tried: false once a limit point lies between two pressures that hardly differ
bool PathFollower::shorten_step(double target) {
  const PathPoint& last = report_.points.back();
  const double length = target - last.s;
  step_ = 0.5 * length;
  failed_s_ = target;
  if (const auto limit = nearest_limit()) {
    const double pressure = last.pressures_Pa[limit->plenum];
    const double wanted = schedule_.value_at(limit->plenum, target);
    if (std::abs(wanted - pressure) < close_to_limit * std::abs(pressure)) return false;
    const double part = (limit->pressure_Pa - pressure) / (wanted - pressure);
    step_ = std::clamp(0.7 * part, 0.1, 0.5) * length;
  }
  return step_ >= options_.smallest_step;
}

/// Ends the path because no further step was found, and states why.
void PathFollower::end_at_smallest_step() {
  const PathPoint& last = report_.points.back();
  if (failed_status_ == io::RunStatus::wall_contact) {
    end(io::RunStatus::wall_contact, "two walls of a chamber touch");
    return;
  }
  if (last.s < 0.0 && failed_status_ == io::RunStatus::limit_point) {
    end(io::RunStatus::limit_point, "the body cannot carry its dead loads: " + failure_);
    return;
  }
  auto limit = nearest_limit();
  const bool is_near =
      limit && std::abs(limit->pressure_Pa - last.pressures_Pa[limit->plenum]) < near_limit * std::abs(limit->pressure_Pa);
  if (failed_status_ != io::RunStatus::limit_point && !is_near) {
    // At large strain, single points of coarse quadratic elements collapse long before the body does.
    const bool collapses = last.smallest_ratio < collapsing_ratio;
    end(failed_status_, failure_ + (collapses ? "; a point of an element has lost more than half of its volume: a finer mesh or "
                                                "elements of degree 1 may go further"
                                              : ""));
    return;
  }
  if (!schedule_.any_is_driven(last.s)) {
    end(io::RunStatus::limit_point, "no stable equilibrium beyond this state of plates and dead loads (" + failure_ + ")");
    return;
  }
  if (!limit) {
    const std::size_t plenum = schedule_.fastest_plenum(last.s, options_.smallest_step);
    limit = LimitPoint{plenum, last.pressures_Pa[plenum], last.plenum_volumes_m3[plenum], false};
  }
  report_.limit_points.push_back(*limit);
  if (options_.ends_at && options_.ends_at(last, report_.limit_points)) {
    report_.status = io::RunStatus::completed;
    return;
  }
  end(io::RunStatus::limit_point,
      "no stable equilibrium beyond this pressure (" + failure_ + "); control by volume passes such a point");
}

void PathFollower::begin() {
  const Body& body = equilibrium_.body();
  bool has_dead_loads = !body.tractions.empty();
  for (const double component : body.gravity_m_per_s2) has_dead_loads = has_dead_loads || component != 0.0;
  // On the ground the whole weight acts at once: without it nothing holds the body down.
  const double start = has_dead_loads && !body.ground && drives_.dead_load_factors.empty() ? -1.0 : 0.0;
  BodyState state = equilibrium_.rest();
  history_.add(start, state);
  const EquilibriumReport report = solve_at(start, state, 0);
  if (report.status != io::RunStatus::completed) {
    end(report.status, report.reason);
    return;
  }
  history_.clear();
  accept(start, state, report, std::nullopt);
}

void PathFollower::resume(const PathRestart& restart) {
  for (std::size_t n = 0; n < restart.s.size(); ++n) history_.add(restart.s[n], restart.states[n]);
  report_.points = restart.points;
  report_.limit_points = restart.limit_points;
  step_ = restart.next_step;
  failed_s_ = restart.failed_s;
  failed_status_ = restart.failed_status;
  failure_ = restart.failure;
  report_.rejected_steps = restart.rejected_steps;
  last_gap_m_ = report_.points.back().smallest_gap_m;
}

PathReport PathFollower::follow(const PathRestart* restart) {
  if (restart != nullptr && !restart->points.empty()) {
    resume(*restart);
  } else {
    begin();
    if (report_.points.empty()) return report_;
  }
  while (report_.points.back().s < schedule_.end() - 1e-12) {
    if (is_told_to_stop(stop_, equilibrium_.space().communicator)) {
      end(io::RunStatus::stopped, "stopped by the user");
      return report_;
    }
    const double s = report_.points.back().s;
    const double station = schedule_.next_station(s, options_.stations);
    double length = std::min(step_, station - s);
    if (!is_barrier_ahead()) failed_s_ = std::numeric_limits<double>::max();
    if (s + length > failed_s_ - 1e-12) {  // a step that far has failed before
      length = 0.5 * (failed_s_ - s);
      if (length < options_.smallest_step) {
        end_at_smallest_step();
        return report_;
      }
    }
    // A remainder shorter than a fifth of a step is added to the step.
    const double target = station - s < 1.2 * length && station < failed_s_ ? station : s + length;
    switch (try_step(target)) {
      case StepOutcome::accepted:
        if (options_.ends_at && options_.ends_at(report_.points.back(), report_.limit_points)) {
          report_.status = io::RunStatus::completed;
          return report_;
        }
        break;
      case StepOutcome::rejected:
        ++report_.rejected_steps;
        if (!shorten_step(target)) {
          end_at_smallest_step();
          return report_;
        }
        break;
      case StepOutcome::ended:
        return report_;
    }
  }
  report_.status = io::RunStatus::completed;
  return report_;
}

}  // namespace

PathReport follow_path(Equilibrium& equilibrium, const PathDrives& drives, const PathOptions& options,
                       const PathObserver& observer, const std::atomic<bool>* stop, const PathRestart* restart) {
  return PathFollower(equilibrium, drives, options, observer, stop).follow(restart);
}

PathReport follow_path(Equilibrium& equilibrium, const std::vector<PlenumDrive>& plena, const PathOptions& options,
                       const PathObserver& observer, const std::atomic<bool>* stop, const PathRestart* restart) {
  return follow_path(equilibrium, PathDrives{.plena = plena}, options, observer, stop, restart);
}

}  // namespace menger::fem
