#pragma once

#include <cmath>

namespace menger::fem {

/// Work done on a body since the start, and what damping and friction have taken out of it, J. Losses are >= 0, those in the
/// material and by friction up to errors of the step.
struct MotionWork {
  double pressure_J = 0.0;  ///< of the chambers' pressure
  /// Of the chambers' pressure where it changes the thickness of walls, which thin-wall elements count apart
  double wall_pressure_J = 0.0;
  double gravity_J = 0.0;       ///< of the weight
  double contact_J = 0.0;       ///< of the ground's springs on the body: minus what is stored in them
  double self_contact_J = 0.0;  ///< of those between parts of the surface: minus what is stored or was lost in them
  double friction_J = 0.0;      ///< lost, or stored in springs along the surface where parts of it stick to each other
  double viscous_J = 0.0;       ///< lost in the material: by its viscosity to first order in the step, by its branches exactly
  double mass_damping_J = 0.0;  ///< lost

  MotionWork& operator+=(const MotionWork& other) {
    pressure_J += other.pressure_J;
    wall_pressure_J += other.wall_pressure_J;
    gravity_J += other.gravity_J;
    contact_J += other.contact_J;
    self_contact_J += other.self_contact_J;
    friction_J += other.friction_J;
    viscous_J += other.viscous_J;
    mass_damping_J += other.mass_damping_J;
    return *this;
  }
};

/// The energies of a body at one time, J.
struct MotionEnergies {
  double kinetic_J = 0.0;
  double strain_J = 0.0;  ///< with what branches store
  MotionWork work;
  double at_start_J = 0.0;  ///< what closes the energy balance in the state that the body was set to

  /// What is there minus what should be there: zero but for errors of second order in the step (first in losses by viscosity).
  [[nodiscard]] double imbalance_J() const {
    const double put_in = work.pressure_J + work.wall_pressure_J + work.gravity_J + work.contact_J + work.self_contact_J;
    const double lost = work.friction_J + work.viscous_J + work.mass_damping_J;
    return kinetic_J + strain_J + lost - put_in - at_start_J;
  }

  /// The sizes of all works, losses and of the energy at the start, added up: what an imbalance is to be compared with.
  [[nodiscard]] double turnover_J() const {
    return std::abs(work.pressure_J) + std::abs(work.gravity_J) + std::abs(work.contact_J) + std::abs(work.friction_J) +
           std::abs(work.viscous_J) + std::abs(work.mass_damping_J) + std::abs(at_start_J) + std::abs(work.self_contact_J) +
           std::abs(work.wall_pressure_J);
  }
};

}  // namespace menger::fem
