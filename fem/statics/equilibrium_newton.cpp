#include <algorithm>
#include <cmath>

#include "fem/statics/equilibrium_search.h"

namespace menger::fem {

namespace {

/// Newton's steps shrink, or the residual does; one step that grew with it may find its way back, more of them do not.
constexpr int most_growing_steps = 2;

}  // namespace

void Equilibrium::Search::function(Vec x, Vec f) {
  unpack(x, displacements_, pressures_);
  residual_.resize(displacements_.size());
  volume_gradients_.resize(body.plenum_count);
  totals_ = assembly.assemble(displacements_, loads(pressures_), residual_, volume_gradients_, nullptr);
  has_answer_ = totals_.smallest_ratio > 0.0 && std::isfinite(totals_.strain_energy_J);

  const std::vector<double> volumes = plenum_volumes(totals_);
  closures_.assign(body.plenum_count, {0.0, 1.0, 0.0});
  std::vector<double> pressure_force(residual_.size(), 0.0);
  for (std::size_t p = 0; p < body.plenum_count; ++p) {
    for (std::size_t n = 0; n < pressure_force.size(); ++n) pressure_force[n] += pressures_[p] * volume_gradients_[p][n];
    if (!is_free(p)) continue;
    const auto closure = plenum_closure(controls_[p], pressures_[p], volumes[p]);
    if (closure) {
      closures_[p] = *closure;
    } else {
      has_answer_ = false;
    }
  }
  residual_N_ = norm_of_owned(residual_);
  reference_N_ =
      std::max(floor_N_, norm_of_owned(pressure_force) + dead_load_factor * dead_load_norm_N_ + totals_.plate_force_norm_N);
  plate_distance_m_ = 0.0;
  for (const auto& [place, imposed_m] : plate_components_)
    plate_distance_m_ = std::max(plate_distance_m_, std::abs(displacements_[place] - imposed_m));
  MPI_Allreduce(MPI_IN_PLACE, &plate_distance_m_, 1, MPI_DOUBLE, MPI_MAX, space.communicator);
  if (!std::isfinite(residual_N_)) has_answer_ = false;

  double* data = nullptr;
  petsc(VecGetArrayWrite(f, &data));
  // PETSc gives up at the first number that is none; a state without an answer is dealt with in the line search
  for (std::size_t n = 0; n < owned_components(); ++n) data[n] = has_answer_ ? residual_[n] : 0.0;
  for (const auto& [place, imposed_m] : plate_components_) data[place] = has_answer_ ? displacements_[place] - imposed_m : 0.0;
  if (rank_ == 0) {
    for (std::size_t p = 0; p < body.plenum_count; ++p) data[owned_components() + p] = closures_[p].residual;
  }
  petsc(VecRestoreArrayWrite(f, &data));
}

/// Puts the plates into a trial state exactly where a step of some length carries them: its arithmetic would leave rounding.
void Equilibrium::Search::carry_along(Vec trial, Vec from, double length) const {
  const double* before = nullptr;
  double* data = nullptr;
  petsc(VecGetArrayRead(from, &before));
  petsc(VecGetArray(trial, &data));
  for (const auto& [place, imposed_m] : plate_components_) data[place] = (1.0 - length) * before[place] + length * imposed_m;
  petsc(VecRestoreArray(trial, &data));
  petsc(VecRestoreArrayRead(from, &before));
}

/// The full step, or as much of it as leaves every volume ratio positive.
void Equilibrium::Search::step(SNESLineSearch line_search) {
  Vec x = nullptr;
  Vec f = nullptr;
  Vec y = nullptr;
  Vec trial = nullptr;
  Vec trial_f = nullptr;
  petsc(SNESLineSearchGetVecs(line_search, &x, &f, &y, &trial, &trial_f));
  std::vector<double> from;
  std::vector<double> unused;
  unpack(x, from, unused);
  double length = 1.0;
  for (; length >= options_.smallest_step_length; length *= 0.5) {
    petsc(VecWAXPY(trial, -length, y, x));
    carry_along(trial, x, length);
    petsc(SNESComputeFunction(snes_, trial, trial_f));
    if (has_answer_) break;
  }
  if (singular_ || !has_answer_) {
    cut_to_nothing_ = !singular_;
    petsc(SNESLineSearchSetReason(line_search, SNES_LINESEARCH_FAILED_REDUCT));
    return;
  }
  std::vector<double> change = displacements_;
  double largest = 0.0;
  for (std::size_t n = 0; n < change.size(); ++n) {
    change[n] -= from[n];
    largest = std::max(largest, std::abs(change[n]));
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, space.communicator);
  if (largest > largest_step_m_ && largest_step_m_ > 0.0 && residual_N_ > residual_before_N_) ++growing_steps_;
  residual_before_N_ = residual_N_;
  runs_away_ = largest > 3.0 * diameter_m_ || growing_steps_ > most_growing_steps;
  largest_step_m_ = largest;
  if (options_.predict_pressure) assembly.elements().predict_pressure(from, change);
  petsc(VecCopy(trial, x));
  petsc(VecCopy(trial_f, f));
  double norm_x = 0.0;
  double norm_f = 0.0;
  double norm_y = 0.0;
  petsc(VecNorm(x, NORM_2, &norm_x));
  petsc(VecNorm(f, NORM_2, &norm_f));
  petsc(VecNorm(y, NORM_2, &norm_y));
  petsc(SNESLineSearchSetNorms(line_search, norm_x, norm_f, norm_y));
  petsc(SNESLineSearchSetReason(line_search, SNES_LINESEARCH_SUCCEEDED));
}

SNESConvergedReason Equilibrium::Search::convergence() const {
  if (stop_ != nullptr && stop_->load()) return SNES_DIVERGED_FUNCTION_COUNT;
  const std::vector<double> volumes = plenum_volumes(totals_);
  bool is_found = plate_distance_m_ == 0.0 && residual_N_ <= options_.relative_force_tolerance * reference_N_;
  for (std::size_t p = 0; p < body.plenum_count; ++p) {
    if (is_free(p) && std::abs(closures_[p].residual) > options_.relative_volume_tolerance * std::abs(volumes[p]))
      is_found = false;
  }
  if (is_found) return SNES_CONVERGED_FNORM_RELATIVE;
  return runs_away_ ? SNES_DIVERGED_DTOL : SNES_CONVERGED_ITERATING;
}

}  // namespace menger::fem
