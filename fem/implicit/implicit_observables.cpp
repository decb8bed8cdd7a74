#include <array>

#include "fem/implicit/implicit_dynamics.h"

namespace menger::fem {

double ImplicitDynamics::plenum_pressure_Pa(std::size_t plenum) const {
  return pressure_Pa(options_.schedules[plenum], state_.time_s);
}

MotionEnergies ImplicitDynamics::energies() {
  MotionEnergies result;
  copy_owned(state_.velocities_m_per_s, work_in_);
  petsc(MatMult(mass_, work_in_, work_out_));
  petsc(VecDot(work_in_, work_out_, &result.kinetic_J));
  result.kinetic_J *= 0.5;
  result.strain_J = forces_.totals.strain_energy_J;
  result.work = state_.work;
  result.at_start_J = state_.at_start_J.value_or(0.0);
  return result;
}

Point ImplicitDynamics::centre_of_mass_m() const {
  Point moment{};
  for (std::size_t node = 0; node < masses_.size(); ++node)
    for (std::size_t i = 0; i < 3; ++i)
      moment[i] += masses_[node] * (space().positions[node][i] + state_.displacements_m[3 * node + i]);
  MPI_Allreduce(MPI_IN_PLACE, moment.data(), 3, MPI_DOUBLE, MPI_SUM, space().communicator);
  return scaled(1.0 / mass_kg_, moment);
}

}  // namespace menger::fem
