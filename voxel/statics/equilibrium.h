#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "io/text/run_status.h"
#include "voxel/statics/force_balance.h"
#include "voxel/statics/modified_newton.h"

namespace menger::voxel {

/// Limits of the search for an equilibrium.
struct EquilibriumOptions {
  double tolerance = 1e-11;          ///< of the largest scaled residual (see ForceBalance), or 1e-6 of its first value if less
  int largest_iteration_count = 20;  ///< of one Newton solution
  int largest_total_count = 400;     ///< of all Newton solutions of one call of load
  double smallest_load_step = 1.0 / 64;  ///< as a fraction of the change of the loads
};

/// Force and moment of a plate on the body.
struct PlateLoad {
  Vector3<double> force{0.0, 0.0, 0.0};   ///< N
  Vector3<double> moment{0.0, 0.0, 0.0};  ///< N m, about the present centre of the plate
};

/// Follows the equilibria of a surrogate body along a path of loads.
///
/// An equilibrium is a root of the scaled residual of ForceBalance. It is found by Newton's method with the exact tangent
/// (ModifiedNewton). Loads go to their target in one step if possible, otherwise in smaller steps, all in proportion.
///
/// Beams keep their small-angle or large-angle state during a solution. Afterwards the rule of the engine, with its hysteresis,
/// is applied to the states before; if a beam changes its state, the equilibrium is solved again. After four such changes beams
/// may only go to the large-angle state, so that this ends. As in the engine, the beam states of an equilibrium may therefore
/// depend on the path.
class Equilibrium {
 public:
  /// Starts at rest, without loads. @param body must outlive this object
  explicit Equilibrium(const StaticBody& body, const Supports& supports = {}, const EquilibriumOptions& options = {});

  /// Goes from the present equilibrium to the one under `target`.
  /// @return completed; limit_point if the laws of the body give no usable size at the pressures (driven_sizes); otherwise
  /// not_converged if no equilibrium was found. After a failure the state is the last equilibrium on the path
  [[nodiscard]] io::RunStatus load(const StaticLoads& target);

  /// Sets the loads and the state of the body, which need not be an equilibrium. For states close to an equilibrium.
  /// @return false, with nothing changed, if the laws of the body give no usable size at the pressures (driven_sizes)
  [[nodiscard]] bool place(const StaticLoads& loads, const StaticState& state);

  [[nodiscard]] const StaticLoads& loads() const { return loads_; }
  [[nodiscard]] const StaticState& state() const { return state_; }
  [[nodiscard]] const Pose& pose(std::size_t node) const { return state_.poses[node]; }
  [[nodiscard]] const ForceBalance& balance() const { return balance_; }
  [[nodiscard]] std::size_t iteration_count() const { return newton_.iteration_count(); }  ///< since construction
  /// Number of factorised tangents since construction.
  [[nodiscard]] std::size_t factorisation_count() const { return newton_.factorisation_count(); }

  [[nodiscard]] PlateLoad plate_load(std::size_t plate) const;
  [[nodiscard]] double ground_force_N() const;                ///< upwards, sum over all voxels
  [[nodiscard]] double axial_strain(std::size_t beam) const;  ///< length / rest length - 1
  /// Computes the stiffness at this equilibrium, scaled as in ForceBalance.
  [[nodiscard]] const Eigen::SparseMatrix<double>& linearise();

 private:
  [[nodiscard]] bool solve();
  [[nodiscard]] bool find_balance();

  const StaticBody* body_;
  EquilibriumOptions options_;
  ForceBalance balance_;
  StaticLoads loads_;
  StaticState state_;
  ModifiedNewton newton_;
  std::size_t iteration_limit_ = 0;
};

}  // namespace menger::voxel
