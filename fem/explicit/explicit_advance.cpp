#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fem/explicit/explicit_dynamics.h"
#include "fem/explicit/gas_stiffness.h"
#include "io/text/formatted.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::fem {
namespace {

/// Change of the stable step from one estimate to the next up to which estimates get rarer, over the distance that steps keep
/// from the stable one: 5 % for steps of four fifths.
constexpr double little_change = 0.25;
constexpr std::size_t least_steps_to_bound = 10;

/// Steps that are left to another one in one order, at most: contact is looked for after some 200.
constexpr std::size_t most_left_steps = 256;

/// Steps that it pays to leave to another one: to go there and back takes as long as some of them.
constexpr std::size_t least_left_steps = 8;

/// Steps after which single precision begins anew at the place of the body: at 1 m/s it has moved on by about an element.
constexpr std::size_t most_followed_steps = 32;

}  // namespace

double ExplicitDynamics::stable_step() {
  set_pressures();
  std::span<const SelfTouch> touches;
  if (options_.self_contact) touches = self_contact_.touches();
  LargestEigenvalues eigenvalues =
      eigenvalues_->at(state_.displacements_m, state_.branches->numbers, *element_forces_, ground_springs_, touches);
  if (state_.pneumatics && options_.supply->has_lines())
    eigenvalues.stiffness_per_s2 +=
        gas_stiffness_per_s2(chambers_, body_, state_.displacements_m, *options_.supply, *state_.pneumatics);
  return stable_step_s(eigenvalues);
}

/// Returns the largest step besides the stable one: that of the options, and the time between two relaxations of a branch.
double ExplicitDynamics::longest_step_s() const {
  const double unlimited = std::numeric_limits<double>::infinity();
  return std::min(options_.largest_step_s.value_or(unlimited), relaxation_interval_s_.value_or(unlimited));
}

const ExplicitReport& ExplicitDynamics::advance_to(double time_s) {
  while (report_.status == io::RunStatus::completed && state_.time_s < time_s) {
    if (options_.stop != nullptr && *options_.stop) {
      report_ = failure(io::RunStatus::stopped, "interrupted");
    } else {
      pass_interval(time_s);
    }
  }
  return report_;
}

void ExplicitDynamics::pass_interval(double time_s) {
  last_good_ = state_;
  const double start = state_.time_s;
  const double stable = state_.stable_step_s;
  common_velocity_ = mean_velocity_m_per_s();
  const std::size_t between_bounds = std::min(state_.steps_to_bound, options_.steps_per_bound);
  std::size_t count = between_bounds - std::min(state_.steps_since_bound, between_bounds - 1);
  double share = state_.step_share;
  std::optional<ExplicitReport> telling;  // of all objections that shorter steps did not remove
  for (;;) {
    const double limit = std::min(options_.step_safety * share * stable, longest_step_s());
    const double wanted = std::max(1.0, std::ceil((time_s - start) / limit * (1.0 - 1e-12)));
    const double step = (time_s - start) / wanted;
    const bool is_last = wanted <= static_cast<double>(count);
    const std::size_t steps = is_last ? static_cast<std::size_t>(wanted) : count;
    const std::optional<ExplicitReport> objection =
        take_steps(step, steps, is_last ? time_s : start + static_cast<double>(steps) * step);
    if (!objection) {
      state_.step_share = share;
      accept(stable);
      return;
    }
    state_ = last_good_;
    energies_.reset();
    self_contact_.forget();
    share *= 0.5;
    count = std::max<std::size_t>(1, steps / 2);
    state_.steps_to_bound = count;
    state_.steps_since_bound = 0;
    // An element that turned inside out says where; the last, shortest steps may end before it does.
    if (!telling || objection->failed_element || !telling->failed_element) telling = objection;
    if (share * stable < options_.smallest_step_ratio * rest_stable_step_) {
      report_ = *telling;
      return;
    }
  }
}

std::optional<ExplicitReport> ExplicitDynamics::take_steps(double step_s, std::size_t count, double end_s) {
  const double start = state_.time_s;
  self_contact_.watch();
  next_leave_ = 0;
  if (options_.step_taker) interval_speed_m_per_s_ = largest_speed_m_per_s();
  std::optional<ExplicitReport> objection;
  std::size_t taken = 0;
  while (taken < count && !objection) {
    if (may_leave_steps(step_s)) {
      const StepsOutcome left = leave_steps(step_s, std::min(count - taken, most_left_steps));
      taken += left.steps;
      elements_follow_ = false;
      if (left.has_failed) objection = failure_in_element();
      state_.steps_since_bound += left.steps;
    } else {
      // Where an interval begins does not depend on interruptions.
      if (taken % most_followed_steps == 0) elements_follow_ = false;
      if (!take_step(step_s)) {
        objection = failure_in_element();
        break;
      }
      elements_follow_ = true;
      ++taken;
      ++state_.steps_since_bound;
    }
    state_.time_s = taken == count ? end_s : start + static_cast<double>(taken) * step_s;
    const PneumaticReport air = supply_air();
    if (air.status != io::RunStatus::completed) objection = failure(air.status, air.reason);
    if (walls_have_met()) break;
  }
  elements_follow_ = false;
  return objection ? objection : check();
}

/// Returns whether it pays to let steps be taken elsewhere: enough of them until something can touch. Looks for contacts where
/// that is due, but not at every step of those that it has found near.
bool ExplicitDynamics::may_leave_steps(double step_s) {
  if (!options_.step_taker || !state_.contact->empty() || state_.steps < next_leave_) return false;
  const double least_travel_m = static_cast<double>(least_left_steps) * step_s * interval_speed_m_per_s_;
  if (self_contact_.free_travel_m() < least_travel_m) {
    if (self_contact_.reads_all_nodes()) {
      set_current_positions();
    } else {
      set_followed_positions();
    }
    find_touches();
  }
  if (self_contact_.free_travel_m() > 0.0 && self_contact_.free_travel_m() >= least_travel_m) return true;
  next_leave_ = state_.steps + least_left_steps;
  return false;
}

/// Lets steps be taken elsewhere, at most `count`, and takes over what they have led to.
StepsOutcome ExplicitDynamics::leave_steps(double step_s, std::size_t count) {
  energies_.reset();
  StepsOrder order{.first_kick_s = 0.5 * (state_.last_step_s + step_s),
                   .step_s = step_s,
                   .count = count,
                   .branch_age_s = state_.branches->age_s,
                   .relaxation_interval_s = relaxation_interval_s_.value_or(0.0),
                   .common_velocity_m_per_s = common_velocity_,
                   .free_travel_m = self_contact_.free_travel_m(),
                   .pressures_Pa = state_.pressures_Pa};
  PneumaticState air = *state_.pneumatics;
  for (std::size_t n = 0; n <= count; ++n) {
    air.time_s = state_.time_s + static_cast<double>(n) * step_s;
    const std::vector<double> pressures = options_.supply->pressures_Pa(air);
    order.pressures_Pa.insert(order.pressures_Pa.end(), pressures.begin(), pressures.end());
  }
  StepsOutcome outcome =
      options_.step_taker->take(order, {state_.displacements_m, state_.velocities_m_per_s, state_.branches->numbers});
  state_.branches->age_s = outcome.branch_age_s;
  clearances_m_.assign(clearances_m_.size(), 0.0);
  if (outcome.steps == 0) return outcome;
  const std::size_t plena = chambers_.plenum_count();
  for (std::size_t p = 0; p < plena; ++p) {
    const double change_Pa = order.pressures_Pa[plena + p] - state_.pressures_Pa[p];
    outcome.work.wall_pressure_J -= 0.5 * state_.pressed_volumes.walls_m3[p] * change_Pa;
    outcome.work.pressure_J -= 0.5 * state_.pressed_volumes.chambers_m3[p] * change_Pa;
  }
  state_.work += outcome.work;
  const auto last = order.pressures_Pa.begin() + static_cast<std::ptrdiff_t>(plena * outcome.steps);
  state_.pressures_Pa.assign(last, last + static_cast<std::ptrdiff_t>(plena));
  state_.pressed_volumes = outcome.volumes;
  self_contact_.passed(outcome.travel_m);
  state_.last_step_s = step_s;
  state_.steps += outcome.steps;
  return outcome;
}

std::optional<ExplicitReport> ExplicitDynamics::check() {
  const MotionEnergies now = energies();
  if (has_failed_element_) return failure_in_element();
  state_.turnover_J = std::max(state_.turnover_J, now.turnover_J());
  const double imbalance = std::abs(now.imbalance_J());
  // Written so that NaN fails, too.
  if (!(imbalance <= options_.largest_imbalance * state_.turnover_J + energy_noise_))
    return failure(io::RunStatus::diverged, "the energy balance has an error of " + io::shown(imbalance) +
                                                " J for a turnover of " + io::shown(state_.turnover_J) + " J");
  if (std::optional<ExplicitReport> objection = check_contact()) return objection;
  if (state_.steps_since_bound < std::min(state_.steps_to_bound, options_.steps_per_bound)) return std::nullopt;
  state_.steps_since_bound = 0;
  state_.stable_step_s = stable_step();
  if (!(state_.stable_step_s >= state_.last_step_s))
    return failure(io::RunStatus::diverged, "the stable step fell to " + io::shown(state_.stable_step_s) + " s");
  return std::nullopt;
}

std::optional<ExplicitReport> ExplicitDynamics::check_contact() const {
  const double depth = self_contact_.largest_depth_m();
  if (options_.self_contact && depth > self_contact_.allowed_depth_m())
    return failure(io::RunStatus::diverged, "parts of the surface are " + io::shown(depth) +
                                                " m deep in each other, too deep for the stiffness of their contact");
  if (self_contact_.largest_travel_m() > self_contact_.allowed_travel_m())
    return failure(io::RunStatus::diverged, "parts of the surface that are near each other moved too far in a step");
  return std::nullopt;
}

bool ExplicitDynamics::walls_have_met() const { return !options_.self_contact && !self_contact_.touches().empty(); }

/// Ends the run for failures that shorter steps would not change, and sets the number of steps to the next estimate of the stable
/// step where it has just been estimated.
void ExplicitDynamics::accept(double last_stable_step_s) {
  look_at_chambers();
  if (state_.stable_step_s < options_.smallest_step_ratio * rest_stable_step_)
    report_ = failure(io::RunStatus::diverged, "the stable step fell to " + io::shown(state_.stable_step_s) + " s");
  const bool has_changed =
      std::abs(state_.stable_step_s / last_stable_step_s - 1.0) > little_change * (1.0 - options_.step_safety);
  if (!has_changed) state_.step_share = std::min(1.0, 1.1 * state_.step_share);
  if (state_.steps_since_bound > 0) return;
  std::size_t& next = state_.steps_to_bound;
  next = has_changed ? std::min(next, std::max(least_steps_to_bound, next / 2)) : std::min(2 * next, options_.steps_per_bound);
}

void ExplicitDynamics::look_at_chambers() {
  const std::vector<double> volumes = chamber_volumes_m3();
  for (std::size_t c = 0; c < volumes.size(); ++c) {
    const double ratio = volumes[c] / first_volumes_[c];
    const std::string chamber = "chamber " + std::to_string(c);
    if (!(ratio > 0.0)) report_ = failure(io::RunStatus::wall_contact, chamber + " has no volume left");
    if (ratio > options_.largest_volume_ratio)
      report_ = failure(io::RunStatus::diverged, chamber + " grew to " + io::shown(ratio) + " times its volume");
  }
  if (!walls_have_met()) return;
  const SelfTouch& touch = self_contact_.touches().front();
  Point position = touch.behind_m;
  for (std::size_t c = 0; c < 4; ++c) {
    const std::size_t first = 3 * std::size_t{touch.face_nodes[c]};
    const Point corner{current_positions_[first], current_positions_[first + 1], current_positions_[first + 2]};
    position = sum(position, scaled(touch.weights[c], corner));
  }
  report_ = failure(io::RunStatus::wall_contact,
                    "walls of chamber " + std::to_string(touch.surface - 1) + " touch at " + meshes::millimetre_text(position));
}

}  // namespace menger::fem
