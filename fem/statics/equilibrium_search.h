#pragma once

// The search behind Equilibrium, in four files: equilibrium.cpp (one search from begin to end), equilibrium_newton.cpp (residual,
// steps, when they end), equilibrium_linear.cpp (stiffness and the equations of the plena), equilibrium_solver.cpp (what PETSc
// calls).

#include <petscsnes.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "fem/space/petsc_handle.h"
#include "fem/statics/equilibrium.h"

namespace menger::fem {

/// One problem and its solvers. Vectors of SNES hold the owned displacement components and, on the first rank, the pressures of
/// all plena; those that are given have the residual zero and do not change.
class Equilibrium::Search {
 public:
  Search(const Space& space, const Body& body, const EquilibriumOptions& options);

  EquilibriumReport solve(BodyState& state, std::span<const PlenumControl> controls, double dead_load_factor,
                          std::span<const double> first_pressures, const std::atomic<bool>* stop);

  const Space& space;
  const Body& body;
  Assembly assembly;

  void assemble_stiffness(std::span<const double> displacements, std::span<const double> pressures);
  [[nodiscard]] std::optional<int> count_negative_pivots(const BodyState& state);
  [[nodiscard]] std::vector<double> plenum_volumes(const BodyTotals& totals) const;
  void move_plates(std::span<const PlateMotion> motions);
  double dead_load_factor = 1.0;

 private:
  // Callbacks of PETSc, with the search as context.
  static PetscErrorCode compute_function(SNES snes, Vec x, Vec f, void* context);
  static PetscErrorCode compute_jacobian(SNES snes, Vec x, Mat jacobian, Mat preconditioner, void* context);
  static PetscErrorCode apply_inverse(PC preconditioner, Vec right_hand_side, Vec solution);
  static PetscErrorCode search_line(SNESLineSearch line_search, void* context);
  static PetscErrorCode test_convergence(SNES snes, PetscInt iteration, PetscReal, PetscReal, PetscReal,
                                         SNESConvergedReason* reason, void* context);

  /// A component that a plate holds: its place among the owned ones, and where it is to be.
  struct PlateComponent {
    std::size_t place;
    double imposed_m;
  };

  void create_solver();
  [[nodiscard]] Loads loads(std::span<const double> pressures) const { return {pressures, dead_load_factor, motions_}; }
  void carry_along(Vec trial, Vec from, double length) const;
  void unpack(Vec x, std::vector<double>& displacements, std::vector<double>& pressures) const;
  void pack(const BodyState& state, Vec x) const;
  void function(Vec x, Vec f);
  void jacobian(Vec x);
  void solve_linear(Vec right_hand_side, Vec solution);
  void step(SNESLineSearch line_search);
  [[nodiscard]] SNESConvergedReason convergence() const;
  [[nodiscard]] bool is_free(std::size_t plenum) const { return !std::holds_alternative<PressureControl>(controls_[plenum]); }
  [[nodiscard]] std::size_t owned_components() const { return 3 * static_cast<std::size_t>(space.owned_count); }
  [[nodiscard]] double norm_of_owned(std::span<const double> field) const;
  [[nodiscard]] std::string failure_reason(int iterations) const;
  [[nodiscard]] EquilibriumReport report_of(SNESConvergedReason reason);

  EquilibriumOptions options_;
  LinearSolver linear_;
  NonlinearSolverHandle snes_;
  MatrixHandle shell_;
  VectorHandle unknown_;
  VectorHandle residual_vector_;
  VectorHandle displacement_part_;
  VectorHandle particular_;
  std::vector<VectorHandle> influences_;  ///< K^-1 dV/du of each plenum that is free
  std::vector<PlateMotion> motions_;
  std::vector<PlateComponent> plate_components_;
  int rank_ = 0;
  bool is_held_;  ///< MUMPS does not notice a singular stiffness
  double diameter_m_ = 0.0;
  double floor_N_ = 0.0;
  double dead_load_norm_N_ = 0.0;

  // Of the running search.
  std::span<const PlenumControl> controls_;
  std::span<const double> first_pressures_;
  const std::atomic<bool>* stop_ = nullptr;
  std::vector<double> displacements_;
  std::vector<double> pressures_;
  std::vector<double> residual_;
  std::vector<std::vector<double>> volume_gradients_;
  std::vector<std::vector<double>> gradients_of_factor_;  ///< of the state whose stiffness is factorised
  std::vector<PlenumClosure> closures_;
  double plate_distance_m_ = 0.0;           ///< largest distance of a held component from where its plate carries it
  std::vector<double> plate_step_m_;        ///< per local component, minus what is left of the way
  std::vector<double> plate_step_force_N_;  ///< K times it
  BodyTotals totals_;
  PetscInt iterations_ = 0;
  bool has_answer_ = false;
  bool singular_ = false;
  bool cut_to_nothing_ = false;
  bool is_first_ = true;
  bool uses_factor_again_ = false;
  double residual_N_ = 0.0;
  double previous_residual_N_ = 0.0;
  double reference_N_ = 0.0;
  double residual_before_N_ = 0.0;
  double largest_step_m_ = 0.0;
  int growing_steps_ = 0;
  bool runs_away_ = false;
};

}  // namespace menger::fem
