#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "io/text/run_status.h"
#include "voxel/statics/force_balance.h"
#include "voxel/statics/modified_newton.h"

namespace menger::voxel {

/// What a path to an equilibrium may cost before it is given up.
struct EquilibriumOptions {
  double tolerance = 1e-11;              ///< of the largest scaled residual (see ForceBalance), or 1e-6 of it at the start
  int largest_iteration_count = 20;      ///< of one Newton solution
  int largest_total_count = 400;         ///< of all Newton solutions of one call of load
  double smallest_load_step = 1.0 / 64;  ///< as a share of the change of the loads
};

/// Force and moment of a plate on the body.
struct PlateLoad {
  Vector3<double> force{0.0, 0.0, 0.0};   ///< N
  Vector3<double> moment{0.0, 0.0, 0.0};  ///< N m, about the centre of the plate where it is now
};

/// Equilibria of a body of the surrogate along a path of loads.
///
/// Each is a root of the scaled residual of ForceBalance, found by Newton's method with the exact tangent (ModifiedNewton). Loads
/// go to their target in one step if they can, else in smaller ones, all in proportion.
///
/// Beams keep their small- or large-angle state during a solution; afterwards the engine's rule, hysteresis included, is applied
/// to where they came from, and a change solves again. From the fourth change on beams only go over to the large-angle state, so
/// that this ends. The states of an equilibrium may thus depend on the path, as they do in the engine.
class Equilibrium {
 public:
  /// At rest, without loads. @param body must outlive this
  explicit Equilibrium(const StaticBody& body, const Supports& supports = {}, const EquilibriumOptions& options = {});

  /// Goes to the equilibrium under `target`, from the present one.
  /// @return completed; limit_point where the pressures lie beyond what a law of the body knows (driven_sizes), else
  /// not_converged where none was found: then the state is the last equilibrium on the way
  [[nodiscard]] io::RunStatus load(const StaticLoads& target);

  /// Puts the body into a state under loads, whether or not it is an equilibrium there, which only a state beside one is for.
  /// @return false, and nothing changes, where the pressures lie beyond what a law of the body knows
  [[nodiscard]] bool place(const StaticLoads& loads, const StaticState& state);

  [[nodiscard]] const StaticLoads& loads() const { return loads_; }
  [[nodiscard]] const StaticState& state() const { return state_; }
  [[nodiscard]] const Pose& pose(std::size_t node) const { return state_.poses[node]; }
  [[nodiscard]] const ForceBalance& balance() const { return balance_; }
  [[nodiscard]] std::size_t iteration_count() const { return newton_.iteration_count(); }          ///< since the beginning
  [[nodiscard]] std::size_t factorisation_count() const { return newton_.factorisation_count(); }  ///< of tangents, since then

  [[nodiscard]] PlateLoad plate_load(std::size_t plate) const;
  [[nodiscard]] double ground_force_N() const;                   ///< upwards, sum over all voxels
  [[nodiscard]] double axial_strain(std::size_t beam) const;     ///< length by rest length, minus 1
  [[nodiscard]] const Eigen::SparseMatrix<double>& linearise();  ///< stiffness at this equilibrium, scaled as in ForceBalance

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
