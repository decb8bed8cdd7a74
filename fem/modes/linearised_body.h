#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fem/space/petsc_handle.h"
#include "fem/statics/equilibrium.h"
#include "fem/statics/linear_solver.h"

namespace menger::fem {

/// A body linearised about a state, for small motions u: K u + M u'' = f.
///
/// K is the tangent of Assembly at the state, the follower load of its pressures included: the pressures keep their values while
/// the body moves, as if every plenum were open to a large reservoir. M is the consistent mass (see assemble_mass). Held
/// components have the identity in K and nothing in M; they answer no force and take part in no motion.
///
/// Holds a factorisation (MUMPS, LDL^T) of K - shift M. The shift is negative, so that a body that may move rigidly has one, too,
/// and small beside the squares of all elastic frequencies: -1e-4 times that of a shear wave across the body,
/// mu / (rho L^2), with the largest shear modulus, the mean density and the diameter of the body's bounding box. All members are
/// collective.
class LinearisedBody {
 public:
  /// @param equilibrium of the same body; the numbers that its elements remember of the last search are forgotten
  /// @param state an equilibrium under its pressures and dead loads: about any other state K means little
  LinearisedBody(Equilibrium& equilibrium, const BodyState& state, double dead_load_factor = 1.0);

  [[nodiscard]] const Assembly& assembly() const { return assembly_; }
  [[nodiscard]] Mat stiffness() const { return stiffness_; }
  [[nodiscard]] Mat mass() const { return mass_; }

  /// (rad/s)^2; minus 1e-4 times the square of the frequency that stands for the body's elastic ones.
  [[nodiscard]] double shift() const { return -relative_shift * elastic_scale_; }

  /// Number of eigenvalues of K x = lambda M x below the shift: > 0 where the state is unstable. Nothing if K - shift M could not
  /// be factorised.
  [[nodiscard]] std::optional<int> eigenvalues_below_shift() const { return below_shift_; }

  /// x = (K - shift M)^-1 b. @return whether a solution was found
  bool solve(Vec b, Vec x) { return solver_.solve(b, x); }

  /// dV/du of a plenum at the state, the force of 1 Pa, m^2, per local component; ghosts not up to date.
  [[nodiscard]] const std::vector<double>& volume_gradient(std::size_t plenum) const { return volume_gradients_[plenum]; }

  /// The motions that cost no energy and that the supports leave the body, at most six, orthonormal in M: rigid motions of its
  /// present shape with K r = 0 but for rounding and the tolerance of the equilibrium.
  [[nodiscard]] std::vector<VectorHandle> free_rigid_motions() const;

  [[nodiscard]] VectorHandle make_vector() const { return solver_.make_vector(); }
  /// A vector of the owned components of a field with 3 numbers per local node, and the way back, with ghosts up to date.
  [[nodiscard]] VectorHandle vector_of(std::span<const double> field) const;
  [[nodiscard]] std::vector<double> field_of(Vec vector) const;

 private:
  static constexpr double relative_shift = 1e-4;
  [[nodiscard]] std::vector<VectorHandle> unheld_rigid_motions() const;

  const Assembly& assembly_;
  LinearSolver solver_;
  MatrixHandle stiffness_;
  MatrixHandle mass_;
  std::vector<double> displacements_;
  std::vector<std::vector<double>> volume_gradients_;
  double elastic_scale_ = 0.0;
  double diameter_m_ = 0.0;
  std::optional<int> below_shift_;
};

}  // namespace menger::fem
