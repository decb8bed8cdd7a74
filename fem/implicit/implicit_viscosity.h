#pragma once

#include <span>
#include <vector>

#include "fem/space/space.h"
#include "fem/statics/assembly.h"

namespace menger::fem {

/// The viscous forces of Kelvin and Voigt's model in the elements of a rank, as in explicit dynamics (see ExplicitMaterial). The
/// viscous Kirchhoff stress is 2 eta dev(d) with the rate of deformation d, so P = 2 eta dev(d) F^-T is added to the elastic
/// stress. The integration is Gauss's rule with degree + 1 points per direction.
class ImplicitViscosity {
 public:
  /// Keeps a reference to the space.
  /// @param viscosities_Pa_s eta >= 0, one per region; empty: no viscosity
  ImplicitViscosity(const Space& space, std::vector<double> viscosities_Pa_s);

  [[nodiscard]] bool is_zero() const { return is_zero_; }

  /// Adds the viscous forces f_a = int P dN_a/dX dV of the elements of this rank.
  /// @param displacements_m, velocities_m_per_s 3 per local node, ghosts up to date; no element may be inverted
  /// @param forces_N per local component, ghosts not up to date
  /// @return the dissipated power, 2 eta |dev d|^2 integrated over the elements of this rank, W, >= 0
  double add_forces(std::span<const double> displacements_m, std::span<const double> velocities_m_per_s,
                    std::span<double> forces_N) const;

  /// Adds `factor` times the damping matrix df/dv (f: viscous forces, v: nodal velocities), which is symmetric and positive
  /// semidefinite. The change of viscous forces with displacements is neglected. It is a part eta |d| / mu of the stiffness, with
  /// the viscosity eta, the rate of deformation d and the shear modulus mu.
  /// @param matrix with the nonzeros of the stiffness; the caller assembles it (MatAssemblyEnd) afterwards
  void add_matrix(const Assembly& assembly, std::span<const double> displacements_m, double factor, Mat matrix) const;

 private:
  const Space& space_;
  std::vector<double> viscosities_;
  bool is_zero_;
};

}  // namespace menger::fem
