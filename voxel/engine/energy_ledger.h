#pragma once

namespace menger::voxel {

/// Energy of a body and the work done on it since the start, all in joules.
///
/// Kinetic energy is that of the half steps, 1/2 p(-)·p(+) / m and 1/2 h(-)·h(+) / I, so that its change over a step is exactly
/// the trapezoidal work of all forces. Work is positive when it adds energy to the body.
struct EnergyLedger {
  double kinetic_J = 0.0;        ///< translation and rotation, at the last full step
  double elastic_J = 0.0;        ///< stored in the beams
  double gravitational_J = 0.0;  ///< relative to the start

  double kinetic_start_J = 0.0;
  double elastic_start_J = 0.0;

  double bond_damping_work_J = 0.0;
  double global_damping_work_J = 0.0;
  double actuation_work_J = 0.0;  ///< done by the change of the rest lengths
  double floor_normal_work_J =
      0.0;                        ///< of the floor's normal force; of a calibrated body also that of walls that bulge against it
  double friction_work_J = 0.0;   ///< kinetic friction and the stops by static friction; with feet also their springs
  double collision_work_J = 0.0;  ///< between voxels
  double load_work_J = 0.0;       ///< of constant external loads

  /// Scale of the residual: largest so far of kinetic + elastic and of the magnitude of gravitational. 0 only if nothing ever
  /// moved.
  double largest_energy_J = 0.0;

  /// Energy that the books do not explain, J: end - start - work.
  [[nodiscard]] double residual_J() const {
    return (kinetic_J + elastic_J + gravitational_J) - (kinetic_start_J + elastic_start_J) -
           (bond_damping_work_J + global_damping_work_J + actuation_work_J + floor_normal_work_J + friction_work_J +
            collision_work_J + load_work_J);
  }

  /// The residual by its scale; 0 if nothing ever moved.
  [[nodiscard]] double residual_share() const { return largest_energy_J > 0.0 ? residual_J() / largest_energy_J : 0.0; }
};

}  // namespace menger::voxel
