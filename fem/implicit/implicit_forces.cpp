#include <algorithm>
#include <cmath>

#include "fem/implicit/implicit_dynamics.h"
#include "fem/modes/mass_matrix.h"

namespace menger::fem {

StepMotion ImplicitDynamics::motion_to(std::span<const double> u) const {
  return {state_.displacements_m, u, trial_.velocities, scheme_.gamma / (scheme_.beta * trial_.step_s)};
}

/// Computes the forces at the end of a step from the displacements u and from the velocities and the time of the trial.
/// @param are_remembered whether the ground forces are those that the state holds
/// @return whether they exist: no element is inverted and the strain energy is finite
bool ImplicitDynamics::compute_forces(std::span<const double> u, Forces& forces, bool are_remembered) {
  forces.residual_N.resize(u.size());
  forces.pressures_Pa.clear();
  for (const PlenumSchedule& schedule : options_.schedules) forces.pressures_Pa.push_back(pressure_Pa(schedule, trial_.time_s));
  assembly_.elements().forget_prediction();
  forces.totals = assembly_.assemble(u, {.plenum_pressures_Pa = forces.pressures_Pa}, forces.residual_N, {}, nullptr);
  if (!(forces.totals.smallest_ratio > 0.0) || !std::isfinite(forces.totals.strain_energy_J)) return false;
  if (!viscosity_.is_zero()) {
    forces.viscous_N.assign(u.size(), 0.0);
    viscosity_.add_forces(u, trial_.velocities, forces.viscous_N);
    assembly_.exchange().add_from_ghosts(forces.viscous_N);
    for (std::size_t n = 0; n < u.size(); ++n)
      if (assembly_.held()[n] == 0) forces.residual_N[n] += forces.viscous_N[n];
  }
  if (contact_) {
    forces.ground_nodes = state_.ground_nodes;
    const GroundTotals own =
        are_remembered ? contact_->add_remembered_forces(u, state_.ground_nodes, forces.residual_N)
                       : contact_->add_forces(motion_to(u), state_.ground_nodes, forces.ground_nodes, forces.residual_N);
    forces.ground = {sum_over_ranks(own.force_N), sum_over_ranks(own.normal_energy_J), sum_over_ranks(own.stick_energy_J),
                     sum_over_ranks(own.friction_loss_J)};
  }
  if (options_.mass_damping_per_s > 0.0) add_mass_damping(forces);
  return true;
}

void ImplicitDynamics::add_mass_damping(Forces& forces) {
  copy_owned(trial_.velocities, work_in_);
  petsc(MatMult(mass_, work_in_, work_out_));
  const double* momentum = nullptr;
  petsc(VecGetArrayRead(work_out_, &momentum));
  forces.mass_damping_N.assign(momentum, momentum + 3 * masses_.size());
  petsc(VecRestoreArrayRead(work_out_, &momentum));
  for (std::size_t n = 0; n < forces.mass_damping_N.size(); ++n) {
    forces.mass_damping_N[n] *= options_.mass_damping_per_s;
    forces.residual_N[n] += forces.mass_damping_N[n];
  }
}

/// Computes accelerations and velocities from the displacements at the end of the step, by Newmark's formulas.
void ImplicitDynamics::follow_displacements(std::span<const double> u) {
  const double h = trial_.step_s;
  const auto& [alpha_m, alpha_f, beta, gamma, error] = scheme_;
  for (std::size_t n = 0; n < u.size(); ++n) {
    const double a0 = state_.accelerations_m_per_s2[n];
    const double v0 = state_.velocities_m_per_s[n];
    const double moved = u[n] - state_.displacements_m[n] - h * v0;
    trial_.accelerations[n] = moved / (beta * h * h) - (0.5 / beta - 1.0) * a0;
    trial_.velocities[n] = v0 + h * ((1.0 - gamma) * a0 + gamma * trial_.accelerations[n]);
  }
}

/// Computes the residual of the scheme's equation, divided by 1 - alpha_f:
///   S1 + M [(1 - am) a1 + am a0] / (1 - af) + af / (1 - af) S0.
bool ImplicitDynamics::compute_residual(Vec x, Vec residual) {
  copy_owned(x, trial_.displacements);
  follow_displacements(trial_.displacements);
  if (!compute_forces(trial_.displacements, trial_.forces)) return false;
  const double share = scheme_.alpha_f / (1.0 - scheme_.alpha_f);
  trial_.residual.resize(3 * masses_.size());
  for (std::size_t n = 0; n < trial_.residual.size(); ++n)
    trial_.residual[n] = trial_.forces.residual_N[n] + share * forces_.residual_N[n];
  add_inertia(trial_.residual);
  copy_owned(trial_.residual, residual);
  return true;
}

/// Accepts an iterate if the remaining change of the displacements is within the tolerance and the forces on the ground are in
/// balance.
NewtonVerdict ImplicitDynamics::check(const NewtonIterate& iterate) const {
  const bool is_near = iterate.distance <= options_.newton_tolerance * tolerance_m_;
  return is_near && is_balanced(trial_.residual) ? NewtonVerdict::solved : NewtonVerdict::go_on;
}

/// Checks whether the residual forces on nodes that touch the ground are small enough. They may be 1 % of the friction there, or
/// the force of one stick spring at the tolerance of the displacements.
///
/// Such a residual force acts like an external one, as friction does, and small ones in one direction add up to a displacement.
/// The walking module of ImplicitDynamics, with stick springs of 10, moved 432 um in three periods when only displacements were
/// checked, 251 um with this check, and 259 um in explicit dynamics.
bool ImplicitDynamics::is_balanced(std::span<const double> residual) const {
  if (!contact_) return true;
  constexpr double part = 0.01;
  const double left = sum_over_ranks(contact_->unbalanced_N(trial_.forces.ground_nodes, residual));
  const double friction = options_.ground->friction.kinetic_coefficient * trial_.forces.ground.force_N;
  const double of_a_spring = contact_->largest_stick_stiffness_N_per_m() * options_.newton_tolerance * tolerance_m_;
  return left <= std::max(part * friction, of_a_spring);
}

void ImplicitDynamics::add_inertia(std::span<double> residual) {
  double* in = nullptr;
  petsc(VecGetArrayWrite(work_in_, &in));
  for (std::size_t n = 0; n < 3 * masses_.size(); ++n) {
    in[n] = ((1.0 - scheme_.alpha_m) * trial_.accelerations[n] + scheme_.alpha_m * state_.accelerations_m_per_s2[n]) /
            (1.0 - scheme_.alpha_f);
  }
  petsc(VecRestoreArrayWrite(work_in_, &in));
  petsc(MatMult(mass_, work_in_, work_out_));
  const double* out = nullptr;
  petsc(VecGetArrayRead(work_out_, &out));
  for (std::size_t n = 0; n < 3 * masses_.size(); ++n) residual[n] += out[n];
  petsc(VecRestoreArrayRead(work_out_, &out));
}

bool ImplicitDynamics::prepare_matrix(Vec x) {
  copy_owned(x, trial_.displacements);
  compute_matrix(trial_.displacements, linear_.matrix());
  return linear_.prepare();
}

void ImplicitDynamics::compute_matrix(std::span<const double> u, Mat matrix) {
  const double h = trial_.step_s;
  const double by_velocity = scheme_.gamma / (scheme_.beta * h);
  const double by_acceleration = (1.0 - scheme_.alpha_m) / ((1.0 - scheme_.alpha_f) * scheme_.beta * h * h);
  assembly_.elements().forget_prediction();
  assembly_.assemble(u, {.plenum_pressures_Pa = trial_.forces.pressures_Pa}, {}, {}, matrix);
  viscosity_.add_matrix(assembly_, u, by_velocity, matrix);
  if (contact_) contact_->add_matrix(motion_to(u), state_.ground_nodes, matrix);
  add_masses(by_acceleration + options_.mass_damping_per_s * by_velocity, matrix);
  factorised_step_s_ = h;
}

/// Computes the accelerations from the forces of the state: M a = -S, by conjugate gradients, as a mass matrix is well
/// conditioned.
void ImplicitDynamics::start_from_forces() {
  LinearSolverHandle solver;
  petsc(KSPCreate(space().communicator, solver.receive()));
  petsc(KSPSetOperators(solver, mass_, mass_));
  petsc(KSPSetType(solver, KSPCG));
  petsc(KSPSetTolerances(solver, 1e-12, PETSC_DEFAULT, PETSC_DEFAULT, 1000));
  PC preconditioner = nullptr;
  petsc(KSPGetPC(solver, &preconditioner));
  petsc(PCSetType(preconditioner, PCJACOBI));
  copy_owned(forces_.residual_N, work_in_);
  petsc(KSPSolve(solver, work_in_, work_out_));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  petsc(KSPGetConvergedReason(solver, &reason));
  if (reason <= 0) fail(io::RunStatus::not_converged, "the accelerations of the start were not found");
  const double* data = nullptr;
  petsc(VecGetArrayRead(work_out_, &data));
  std::vector<double>& a = state_.accelerations_m_per_s2;
  a.assign(state_.displacements_m.size(), 0.0);
  for (std::size_t n = 0; n < 3 * masses_.size(); ++n) a[n] = -data[n];
  petsc(VecRestoreArrayRead(work_out_, &data));
  assembly_.exchange().update_ghosts(a);
}

}  // namespace menger::fem
