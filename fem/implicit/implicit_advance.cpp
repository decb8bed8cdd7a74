#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/implicit/implicit_dynamics.h"
#include "io/text/number_text.h"

namespace menger::fem {
namespace {

constexpr double close_steps = 1.2;  // ratio of steps that can share a factorisation
constexpr double touching_gap = 1e-3;
constexpr double moment_s = 1e-9;  // too short for a step: its accelerations would be rounding errors

}  // namespace

const ImplicitReport& ImplicitDynamics::advance_to(double time_s) {
  while (report_.status == io::RunStatus::completed && state_.time_s < time_s) {
    if (is_told_to_stop(options_.stop, space().communicator)) {
      fail(io::RunStatus::stopped, "interrupted");
    } else if (time_s - state_.time_s < moment_s) {
      state_.time_s = time_s;
    } else {
      pass_step(time_s);
    }
  }
  return report_;
}

void ImplicitDynamics::fail(io::RunStatus status, const std::string& reason) {
  report_ = {status, reason + " at " + io::number_text(state_.time_s) + " s"};
}

/// Takes one good step. The time that remains is divided into equal steps. No step is taken if the run is stopped within it.
void ImplicitDynamics::pass_step(double end_s) {
  std::vector<double> u;
  for (;;) {
    const double left = end_s - state_.time_s;
    const double wanted = std::min(state_.next_step_s, options_.largest_step_s);
    const double count = std::max(1.0, std::ceil(left / wanted * (1.0 - 1e-9)));
    const double step = left / count;
    trial_.time_s = count == 1.0 ? end_s : state_.time_s + step;
    const StepOutcome outcome = try_step(step, u);
    if (outcome == StepOutcome::good) {
      if (count > 1.0 || error_ > 0.5) state_.next_step_s = next_step_s(step, error_, wanted);
      accept(std::move(u));
      return;
    }
    if (outcome == StepOutcome::stopped) return;
    ++state_.rejected_steps;
    state_.next_step_s = outcome == StepOutcome::inaccurate ? std::min(0.9 * step, next_step_s(step, error_, step)) : 0.4 * step;
    if (state_.next_step_s >= options_.smallest_step_s) continue;
    switch (outcome) {
      case StepOutcome::inverted:
        fail(io::RunStatus::inverted_element,
             "an element would turn inside out or be stretched beyond the limit of its law, however short the step");
        break;
      case StepOutcome::crossing:
        fail(io::RunStatus::wall_contact, "chamber walls touch");
        break;
      default:
        fail(io::RunStatus::not_converged, "no step as short as " + io::number_text(options_.smallest_step_s) + " s converges");
    }
    return;
  }
}

/// Tries a step and checks its error and the walls.
/// @param u displacements at the end of the step
ImplicitDynamics::StepOutcome ImplicitDynamics::try_step(double step_s, std::vector<double>& u) {
  trial_.step_s = step_s;
  u = state_.displacements_m;
  for (std::size_t n = 0; n < u.size(); ++n)
    u[n] += step_s * (state_.velocities_m_per_s[n] + 0.5 * step_s * state_.accelerations_m_per_s2[n]);
  if (std::max(step_s, factorised_step_s_) > close_steps * std::min(step_s, factorised_step_s_)) newton_.forget_tangent();
  copy_owned(u, unknown_);
  const NewtonOutcome outcome = newton_.solve(unknown_, options_.stop);
  if (outcome.end == NewtonEnd::stopped) return StepOutcome::stopped;
  state_.iterations += static_cast<std::size_t>(outcome.iterations);
  if (outcome.end == NewtonEnd::no_residual) return StepOutcome::inverted;
  if (outcome.end != NewtonEnd::solved) return StepOutcome::unsolved;
  copy_owned(unknown_, u);
  error_ = error_of_step() / tolerance_m_;
  if (!(error_ <= 1.0)) return StepOutcome::inaccurate;
  return look_at_walls(u);
}

/// Returns the size of the local error of the step: c h^2 (a1 - a0), filtered by the matrix that was factorised last. In that
/// matrix, M has the factor m of the step for which it was made.
double ImplicitDynamics::error_of_step() {
  const double h = trial_.step_s;
  const double mass_factor =
      (1.0 - scheme_.alpha_m) / ((1.0 - scheme_.alpha_f) * scheme_.beta * factorised_step_s_ * factorised_step_s_);
  std::vector<double> error(trial_.accelerations.size());
  for (std::size_t n = 0; n < error.size(); ++n)
    error[n] = scheme_.error_constant * h * h * (trial_.accelerations[n] - state_.accelerations_m_per_s2[n]);
  copy_owned(error, work_in_);
  petsc(VecScale(work_in_, mass_factor));
  petsc(MatMult(mass_, work_in_, work_out_));
  if (!linear_.solve(work_out_, work_in_)) return size_of(error);
  const double* data = nullptr;
  petsc(VecGetArrayRead(work_in_, &data));
  std::copy_n(data, 3 * masses_.size(), error.begin());
  petsc(VecRestoreArrayRead(work_in_, &data));
  return size_of(error);
}

/// Returns an upper bound of how much closer two points of the body have come: twice the largest displacement relative to the
/// mean one.
double ImplicitDynamics::approach_m(std::span<const double> from, std::span<const double> to) const {
  Point mean{};
  for (std::size_t n = 0; n < 3 * masses_.size(); ++n) mean[n % 3] += masses_[n / 3] * (to[n] - from[n]) / mass_kg_;
  MPI_Allreduce(MPI_IN_PLACE, mean.data(), 3, MPI_DOUBLE, MPI_SUM, space().communicator);
  double square = 0.0;
  for (std::size_t node = 0; node < masses_.size(); ++node) {
    Point relative{};
    for (std::size_t i = 0; i < 3; ++i) relative[i] = to[3 * node + i] - from[3 * node + i] - mean[i];
    square = std::max(square, dot(relative, relative));
  }
  MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_MAX, space().communicator);
  return 2.0 * std::sqrt(square);
}

/// Checks the walls of the chambers for crossings. The check is made where a chamber has shrunk and its walls may have closed
/// half of their gap since the last check. It is first made at the start of this step, so that an undetected crossing can only
/// have happened within this step.
ImplicitDynamics::StepOutcome ImplicitDynamics::look_at_walls(std::span<const double> u) {
  const std::vector<double>& volumes = trial_.forces.totals.chamber_volumes_m3;
  bool shrinks = false;
  for (std::size_t c = 0; c < volumes.size(); ++c) shrinks = shrinks || volumes[c] < 0.999 * first_volumes_[c];
  if (!shrinks) return StepOutcome::good;
  if (gap_m_ && approach_m(gap_displacements_, u) < 0.5 * *gap_m_) return StepOutcome::good;
  if (!look_from(state_.displacements_m)) return StepOutcome::crossing;
  if (gap_m_ && approach_m(state_.displacements_m, u) > *gap_m_ + gaps_.recognised_depth_m()) return StepOutcome::crossing;
  return look_from(u) ? StepOutcome::good : StepOutcome::crossing;
}

/// Searches the smallest gap between chamber walls and stores it.
/// @return whether no walls cross
bool ImplicitDynamics::look_from(std::span<const double> u) {
  const std::optional<WallGap> gap = gaps_.smallest(u);
  gap_m_.reset();
  if (!gap) return true;
  if (gap->is_crossing) return false;
  gap_m_ = gap->gap_m;
  gap_displacements_.assign(u.begin(), u.end());
  return true;
}

/// Returns the work of the mean of two forces over the step to u, J.
double ImplicitDynamics::mean_work(std::span<const double> before, std::span<const double> after,
                                   std::span<const double> u) const {
  double work = 0.0;
  if (!after.empty())
    for (std::size_t n = 0; n < 3 * masses_.size(); ++n)
      work += 0.5 * (before[n] + after[n]) * (u[n] - state_.displacements_m[n]);
  return sum_over_ranks(work);
}

void ImplicitDynamics::accept(std::vector<double>&& u) {
  const Forces& now = trial_.forces;
  MotionWork& work = state_.work;
  for (std::size_t c = 0; c < body_.chambers.size(); ++c) {
    const std::size_t plenum = body_.chambers[c].plenum;
    work.pressure_J += 0.5 * (forces_.pressures_Pa[plenum] + now.pressures_Pa[plenum]) *
                       (now.totals.chamber_volumes_m3[c] - forces_.totals.chamber_volumes_m3[c]);
  }
  work.gravity_J += now.totals.dead_load_work_J - forces_.totals.dead_load_work_J;
  work.contact_J = -(now.ground.normal_energy_J + now.ground.stick_energy_J);
  work.friction_J += now.ground.friction_loss_J;
  work.viscous_J += mean_work(forces_.viscous_N, now.viscous_N, u);
  work.mass_damping_J += mean_work(forces_.mass_damping_N, now.mass_damping_N, u);
  state_.time_s = trial_.time_s;
  state_.displacements_m = std::move(u);
  std::swap(state_.velocities_m_per_s, trial_.velocities);
  std::swap(state_.accelerations_m_per_s2, trial_.accelerations);
  std::swap(forces_, trial_.forces);
  state_.ground_nodes = forces_.ground_nodes;
  ++state_.steps;
  const std::vector<double>& volumes = forces_.totals.chamber_volumes_m3;
  for (std::size_t c = 0; c < volumes.size(); ++c) {
    const double ratio = volumes[c] / first_volumes_[c];
    if (ratio > options_.largest_volume_ratio)
      fail(io::RunStatus::diverged, "chamber " + std::to_string(c) + " grew to " + io::number_text(ratio) + " times its volume");
  }
  if (gap_m_ && *gap_m_ <= touching_gap * gaps_.size_m()) fail(io::RunStatus::wall_contact, "chamber walls touch");
}

}  // namespace menger::fem
