#include <Eigen/Dense>
#include <algorithm>

#include "fem/statics/equilibrium_search.h"

namespace menger::fem {

namespace {

/// A factorisation is used again if the residual fell at least by the first factor with it when it was new, and after that as
/// long as it falls by the second: the cost of a few solves against that of a factorisation.
constexpr double fast_reduction = 0.02;
constexpr double lasting_reduction = 0.2;

}  // namespace

void Equilibrium::Search::assemble_stiffness(std::span<const double> displacements, std::span<const double> pressures) {
  if (plate_distance_m_ == 0.0) {
    assembly.assemble(displacements, loads(pressures), {}, {}, linear_.matrix());
    return;
  }
  plate_step_m_.assign(displacements.size(), 0.0);
  plate_step_force_N_.assign(displacements.size(), 0.0);
  for (const auto& [place, imposed_m] : plate_components_) plate_step_m_[place] = displacements[place] - imposed_m;
  assembly.exchange().update_ghosts(plate_step_m_);
  const HeldChange step{plate_step_m_, plate_step_force_N_};
  assembly.assemble(displacements, loads(pressures), {}, {}, linear_.matrix(), &step);
}

std::optional<int> Equilibrium::Search::count_negative_pivots(const BodyState& state) {
  assembly.elements().forget_prediction();
  plate_distance_m_ = 0.0;
  assemble_stiffness(state.displacements_m, state.plenum_pressures_Pa);
  return linear_.prepare() ? linear_.negative_pivots() : std::nullopt;
}

void Equilibrium::Search::jacobian(Vec x) {
  const double reduction = uses_factor_again_ ? lasting_reduction : fast_reduction;
  uses_factor_again_ = !is_first_ && plate_distance_m_ == 0.0 && residual_N_ < reduction * previous_residual_N_;
  previous_residual_N_ = residual_N_;
  if (uses_factor_again_) return;
  unpack(x, displacements_, pressures_);
  const bool uses_first = is_first_ && !first_pressures_.empty();
  const std::span<const double> pressures = uses_first ? first_pressures_ : std::span<const double>(pressures_);
  is_first_ = false;
  assemble_stiffness(displacements_, pressures);
  gradients_of_factor_ = volume_gradients_;
  if (!linear_.prepare()) {
    singular_ = true;
    return;
  }
  for (std::size_t p = 0; p < body.plenum_count; ++p) {
    if (!is_free(p)) continue;
    double* data = nullptr;
    petsc(VecGetArrayWrite(displacement_part_, &data));
    std::copy_n(volume_gradients_[p].begin(), owned_components(), data);
    petsc(VecRestoreArrayWrite(displacement_part_, &data));
    if (!linear_.solve(displacement_part_, influences_[p])) singular_ = true;
  }
}

/// Solves K y - sum_p V_p y_p = r, V_p . y + c_p y_p = c for every free plenum p, V_p being dV_p/du. On a plate y = r, and K y
/// there goes to the right-hand side; V_p leaves it out, which only the first step of a plate notices.
void Equilibrium::Search::solve_linear(Vec right_hand_side, Vec solution) {
  petsc(VecZeroEntries(solution));
  if (singular_) return;
  const double* r = nullptr;
  double* data = nullptr;
  petsc(VecGetArrayRead(right_hand_side, &r));
  petsc(VecGetArrayWrite(displacement_part_, &data));
  std::copy_n(r, owned_components(), data);
  if (plate_distance_m_ > 0.0)
    for (std::size_t n = 0; n < owned_components(); ++n) data[n] -= plate_step_force_N_[n];
  petsc(VecRestoreArrayWrite(displacement_part_, &data));
  petsc(VecRestoreArrayRead(right_hand_side, &r));
  if (!linear_.solve(displacement_part_, particular_)) {
    singular_ = true;
    return;
  }

  std::vector<std::size_t> free;
  for (std::size_t p = 0; p < body.plenum_count; ++p)
    if (is_free(p)) free.push_back(p);
  const auto count = static_cast<Eigen::Index>(free.size());
  const auto times_gradient = [&](std::size_t plenum, Vec vector) {
    const double* values = nullptr;
    petsc(VecGetArrayRead(vector, &values));
    double sum = 0.0;
    for (std::size_t n = 0; n < owned_components(); ++n) sum += gradients_of_factor_[plenum][n] * values[n];
    petsc(VecRestoreArrayRead(vector, &values));
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, space.communicator);
    return sum;
  };
  Eigen::MatrixXd schur(count, count);
  Eigen::VectorXd right(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t p = free[static_cast<std::size_t>(i)];
    right[i] = closures_[p].residual - times_gradient(p, particular_);
    for (Eigen::Index j = 0; j < count; ++j) schur(i, j) = times_gradient(p, influences_[free[static_cast<std::size_t>(j)]]);
    schur(i, i) += closures_[p].by_pressure;
  }
  Eigen::VectorXd changes(count);
  if (count > 0) changes = schur.fullPivLu().solve(right);
  for (Eigen::Index j = 0; j < count; ++j)
    petsc(VecAXPY(particular_, changes[j], influences_[free[static_cast<std::size_t>(j)]]));

  const double* y = nullptr;
  petsc(VecGetArrayRead(particular_, &y));
  petsc(VecGetArrayWrite(solution, &data));
  std::fill_n(data, owned_components() + (rank_ == 0 ? body.plenum_count : 0), 0.0);
  std::copy_n(y, owned_components(), data);
  if (rank_ == 0) {
    for (std::size_t j = 0; j < free.size(); ++j) data[owned_components() + free[j]] = changes[static_cast<Eigen::Index>(j)];
  }
  petsc(VecRestoreArrayWrite(solution, &data));
  petsc(VecRestoreArrayRead(particular_, &y));
}

}  // namespace menger::fem
