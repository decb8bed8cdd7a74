#pragma once

namespace menger::voxel {

/// The energy balance of a body: its energy now and at the start, and the work done on it since then, all in joules.
///
/// Kinetic energy is computed from the half steps before (-) and after (+) a full step, as 1/2 p(-)·p(+) / m and
/// 1/2 h(-)·h(+) / I, with the momentum p and the angular momentum h. Its change over a step is then exactly the work of all
/// forces by the trapezoidal rule. Work is positive when it adds energy to the body.
struct EnergyLedger {
  double kinetic_J = 0.0;        ///< translation and rotation, at the last full step
  double elastic_J = 0.0;        ///< stored in the beams and in their lateral coupling
  double gravitational_J = 0.0;  ///< relative to the start

  double kinetic_start_J = 0.0;
  double elastic_start_J = 0.0;

  double bond_damping_work_J = 0.0;
  double global_damping_work_J = 0.0;
  double actuation_work_J = 0.0;  ///< done by the change of the rest lengths
  /// Of the floor's normal force. For a calibrated body it includes that of walls that bulge against the floor.
  double floor_normal_work_J = 0.0;
  double friction_work_J = 0.0;   ///< kinetic friction and the stops by static friction; for feet also their springs
  double collision_work_J = 0.0;  ///< between voxels
  double load_work_J = 0.0;       ///< of constant external loads

  /// Scale of the residual: the largest value so far of kinetic + elastic and of the magnitude of gravitational. 0 only if
  /// nothing ever moved.
  double largest_energy_J = 0.0;

  /// Returns the energy that the balance does not explain, J: end - start - work.
  [[nodiscard]] double residual_J() const {
    return (kinetic_J + elastic_J + gravitational_J) - (kinetic_start_J + elastic_start_J) -
           (bond_damping_work_J + global_damping_work_J + actuation_work_J + floor_normal_work_J + friction_work_J +
            collision_work_J + load_work_J);
  }

  /// Returns the residual divided by its scale; 0 if nothing ever moved.
  [[nodiscard]] double residual_share() const { return largest_energy_J > 0.0 ? residual_J() / largest_energy_J : 0.0; }
};

}  // namespace menger::voxel
