#include "fem/explicit/explicit_contact.h"
#include "fem/explicit/explicit_dynamics.h"
#include "meshes/load_cases/observables.h"

namespace menger::fem {

std::vector<double> ExplicitDynamics::positions_m() const {
  std::vector<double> positions = body_.reference_positions_m();
  for (std::size_t n = 0; n < positions.size(); ++n) positions[n] += state_.displacements_m[n];
  return positions;
}

std::vector<double> ExplicitDynamics::velocities_m_per_s() { return half_step().velocities; }

std::vector<double> ExplicitDynamics::plenum_volumes_m3() const { return chambers_.plenum_sums(chamber_volumes_m3()); }

double ExplicitDynamics::plenum_pressure_Pa(std::size_t plenum) const {
  return options_.supply->pressure_Pa(*state_.pneumatics, plenum);
}

/// Advances the pneumatic supply to the time of the state.
PneumaticReport ExplicitDynamics::supply_air() {
  if (air_) return air_->advance(*state_.pneumatics, state_.time_s, plenum_volumes_m3());
  state_.pneumatics->time_s = state_.time_s;
  return {.time_s = state_.time_s};
}

MotionEnergies ExplicitDynamics::energies() {
  if (!energies_) energies_ = energies_since_start();
  MotionEnergies result = *energies_;
  result.at_start_J = state_.at_start_J.value_or(0.0);
  return result;
}

/// Returns the energies of the state, as if the energy balance had begun at zero. Computes the forces of the state.
MotionEnergies ExplicitDynamics::energies_since_start() {
  const HalfStep half = half_step();
  MotionEnergies result;
  for (std::size_t n = 0; n < half.velocities.size(); ++n)
    result.kinetic_J += 0.5 * body_.masses_kg()[n / 3] * half.velocities[n] * half.velocities[n];
  result.strain_J = body_.elements().strain_energy_J(state_.displacements_m, state_.branches->numbers);
  result.work = state_.work;
  result.work += half.work;
  for (std::size_t p = 0; p < pressures_Pa_.size(); ++p) {
    result.work.wall_pressure_J += pressures_Pa_[p] * pressed_volumes_.walls_m3[p];
    result.work.pressure_J += pressures_Pa_[p] * pressed_volumes_.chambers_m3[p];
  }
  for (std::size_t n = 0; n < state_.displacements_m.size(); ++n)
    result.work.gravity_J += body_.masses_kg()[n / 3] * options_.loads.gravity_m_per_s2[n % 3] * state_.displacements_m[n];
  return result;
}

double ExplicitDynamics::ground_force_N() const {
  return options_.loads.ground ? fem::ground_force_N(*options_.loads.ground, positions_m(), areas_) : 0.0;
}

std::vector<SelfTouch> ExplicitDynamics::self_touches() {
  if (!options_.self_contact) return {};
  compute_forces();
  return self_contact_.touches();
}

/// Returns the mean velocity weighted by mass, half a step before the state.
Point ExplicitDynamics::mean_velocity_m_per_s() const {
  Point momentum{};
  for (std::size_t n = 0; n < state_.velocities_m_per_s.size(); ++n)
    momentum[n % 3] += body_.masses_kg()[n / 3] * state_.velocities_m_per_s[n];
  return scaled(1.0 / body_.mass_kg(), momentum);
}

Point ExplicitDynamics::centre_of_mass_m() const {
  const std::vector<double> flat = positions_m();
  std::vector<Point> positions(body_.node_count());
  for (std::size_t n = 0; n < flat.size(); ++n) positions[n / 3][n % 3] = flat[n];
  return meshes::centre_of_mass(positions, body_.masses_kg());
}

const ExplicitReport& follow(ExplicitDynamics& dynamics, const std::vector<double>& times_s,
                             const std::function<void(ExplicitDynamics&)>& observe) {
  observe(dynamics);
  for (const double time : times_s) {
    if (dynamics.advance_to(time).status != io::RunStatus::completed) break;
    observe(dynamics);
  }
  return dynamics.advance_to(dynamics.state().time_s);
}

}  // namespace menger::fem
