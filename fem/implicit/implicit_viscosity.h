#pragma once

#include <span>
#include <vector>

#include "fem/space/space.h"
#include "fem/statics/assembly.h"

namespace menger::fem {

/// Kelvin and Voigt's viscosity in the elements of a rank, the material of explicit dynamics (see ExplicitMaterial): the viscous
/// Kirchhoff stress is 2 eta dev(d), d the rate of deformation, so P = 2 eta dev(d) F^-T beside the elastic one. Gauss's rule
/// with degree + 1 points per direction.
class ImplicitViscosity {
 public:
  /// Keeps a reference. @param viscosities_Pa_s eta >= 0, one per region; empty: none
  ImplicitViscosity(const Space& space, std::vector<double> viscosities_Pa_s);

  [[nodiscard]] bool is_zero() const { return is_zero_; }

  /// Adds f_a = int P dN_a/dX dV of the elements here. @param displacements_m, velocities_m_per_s 3 per local node, ghosts up to
  /// date; no element may be inside out @param forces_N per local component, ghosts not up to date
  /// @return 2 eta |dev d|^2 over the elements here, W, >= 0
  double add_forces(std::span<const double> displacements_m, std::span<const double> velocities_m_per_s,
                    std::span<double> forces_N) const;

  /// Adds `factor` times the damping matrix df/dv (f: viscous forces, v: velocities of nodes; symmetric, positive semidefinite).
  /// That viscous forces change with displacements, too, is left out: a part eta |d| / mu of the stiffness, with the viscosity
  /// eta, the rate of deformation d and the shear modulus mu.
  /// @param matrix with the nonzeros of the stiffness; PETSc must still be adding to it (no MatAssemblyEnd before)
  void add_matrix(const Assembly& assembly, std::span<const double> displacements_m, double factor, Mat matrix) const;

 private:
  const Space& space_;
  std::vector<double> viscosities_;
  bool is_zero_;
};

}  // namespace menger::fem
