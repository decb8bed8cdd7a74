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
/// K is the tangent of Assembly at the state. It includes the follower load of its pressures. The pressures keep their values
/// while the body moves, as if every plenum were open to a large reservoir. M is the mass of assemble_mass. Held
/// components have the identity in K and zero in M. They respond to no force and take part in no motion.
///
/// It holds a factorisation (MUMPS, LDL^T) of K - shift M. The shift is negative, so that the factorisation also exists for a
/// body that can move rigidly. It is small compared with the squares of all elastic frequencies: -1e-4 times that of a shear wave
/// across the body, mu / (rho L^2), with the largest shear modulus, the mean density and the diameter of the body's bounding box.
/// All members are collective.
class LinearisedBody {
 public:
  /// @param equilibrium of the same body; the element pressures predicted in its last search are discarded
  /// @param state an equilibrium under its pressures and dead loads; about any other state K has little meaning
  LinearisedBody(Equilibrium& equilibrium, const BodyState& state, double dead_load_factor = 1.0);

  [[nodiscard]] const Assembly& assembly() const { return assembly_; }
  [[nodiscard]] Mat stiffness() const { return stiffness_; }
  [[nodiscard]] Mat mass() const { return mass_; }

  /// The shift, (rad/s)^2: minus 1e-4 times the square of the frequency that represents the body's elastic ones.
  [[nodiscard]] double shift() const { return -relative_shift * elastic_scale_; }

  /// Returns the number of eigenvalues of K x = lambda M x below the shift; > 0 where the state is unstable. Nothing if K - shift
  /// M could not be factorised.
  [[nodiscard]] std::optional<int> eigenvalues_below_shift() const { return below_shift_; }

  /// Solves x = (K - shift M)^-1 b. @return whether a solution was found
  bool solve(Vec b, Vec x) { return solver_.solve(b, x); }

  /// Returns dV/du of a plenum at the state, which is the force of 1 Pa, m^2, per local component; ghosts not up to date.
  [[nodiscard]] const std::vector<double>& volume_gradient(std::size_t plenum) const { return volume_gradients_[plenum]; }

  /// Returns the motions without energy that the supports leave free, at most six, orthonormal in M. They are rigid motions of
  /// the present shape, with K r = 0 up to rounding and the tolerance of the equilibrium.
  [[nodiscard]] std::vector<VectorHandle> free_rigid_motions() const;

  [[nodiscard]] VectorHandle make_vector() const { return solver_.make_vector(); }
  /// Returns a vector of the owned components of a field with 3 numbers per local node. field_of does the reverse, with ghosts up
  /// to date.
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
