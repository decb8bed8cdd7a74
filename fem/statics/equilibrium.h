#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "fem/space/petsc_handle.h"
#include "fem/statics/assembly.h"
#include "fem/statics/linear_solver.h"
#include "fem/statics/newton_solver.h"
#include "fem/surfaces/gas_law.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// Limits of one search for an equilibrium.
struct EquilibriumOptions {
  int largest_iteration_count = 25;
  /// The residual's norm may be this part of the loads': that of the pressure forces on components that are not held plus those
  /// of the dead loads and of the plates, and at least a ten-thousandth of shear modulus x length^2.
  double relative_force_tolerance = 1e-7;
  double relative_volume_tolerance = 1e-9;  ///< of a plenum under control by volume or gas
  double smallest_step_length = 1.0 / 64;   ///< part of a Newton step to which it is cut back to keep volume ratios positive
  bool predict_pressure = true;             ///< Newton's method of the three fields; false: of the displacements alone
  LinearOptions linear;
};

/// A state of a body, equilibrium or not.
struct BodyState {
  std::vector<double> displacements_m;      ///< 3 per local node, ghosts up to date
  std::vector<double> plenum_pressures_Pa;  ///< gauge
  std::vector<double>
      element_pressures_Pa;  ///< at quadrature points, as ElementGroups numbers them; empty: those of the displacements
};

/// How a search for an equilibrium ended.
struct EquilibriumReport {
  io::RunStatus status = io::RunStatus::not_converged;  ///< completed, not_converged, inverted_element or stopped
  std::string reason;                                   ///< why it is not completed, for people
  int iterations = 0;
  int factorisations = 0;
  double residual_N = 0.0;
  double reference_force_N = 0.0;
  BodyTotals totals;                      ///< at the state that was reached
  std::vector<double> plenum_volumes_m3;  ///< of the modelled part
  std::optional<int> negative_pivots;     ///< of the last factorisation; > 0: unstable under dead pressure
};

/// Finds equilibria of a body: zeros of the residual of Assembly, together with the equation of every plenum.
///
/// Newton's method, see NewtonSolver. Unknowns are the displacements and the pressures of plena that are not given (bordered
/// system, eliminated with the factorisation of the stiffness). Full steps, cut back only where volume ratios would not stay
/// positive: the residual's norm may grow by orders of magnitude on the way to a bent wall, so it does not steer the steps. A
/// factorisation is used again as long as the residual falls fast with it.
///
/// Plates: that a held component is where its plate carries it is one more equation, linear, so that the first full step fulfils
/// it exactly, and the nodes within follow by the stiffness at the start of the step. A step that is cut back carries the plate
/// part of the way, and the next ones the rest.
class Equilibrium {
 public:
  /// Keeps references.
  Equilibrium(const Space& space, const Body& body, const EquilibriumOptions& options);
  Equilibrium(const Equilibrium&) = delete;
  Equilibrium& operator=(const Equilibrium&) = delete;

  /// The state at rest, pressures zero.
  [[nodiscard]] BodyState rest() const;

  /// Improves a state until it is an equilibrium; left as reached.
  /// @param controls one per plenum
  /// @param pressures_of_first_stiffness pressures, one per plenum, to linearise the first iteration with (those of the last
  /// equilibrium, if the state is that one still); empty: those of the state
  EquilibriumReport solve(BodyState& state, std::span<const PlenumControl> controls, double dead_load_factor,
                          std::span<const double> pressures_of_first_stiffness = {}, const std::atomic<bool>* stop = nullptr);

  /// Where the plates are to be in the next searches, one motion per plate (asserts); at rest before the first call.
  void move_plates(std::span<const PlateMotion> motions);

  /// Number of negative eigenvalues of the stiffness at a state and its pressures: 0 where it is stable under them. Costs a
  /// factorisation; nothing with the iterative method.
  std::optional<int> count_negative_pivots(const BodyState& state, double dead_load_factor);

  /// Totals of any state, and the volume of each plenum.
  BodyTotals totals(const BodyState& state, double dead_load_factor);
  [[nodiscard]] std::vector<double> plenum_volumes(const BodyTotals& totals) const;

  [[nodiscard]] Assembly& assembly() { return assembly_; }
  [[nodiscard]] const Space& space() const { return space_; }
  [[nodiscard]] const Body& body() const { return body_; }

 private:
  /// A component that a plate holds: its place among the owned ones, and where it is to be.
  struct PlateComponent {
    std::size_t place;
    double imposed_m;
  };

  [[nodiscard]] VectorHandle make_unknowns() const;
  [[nodiscard]] NewtonProblem problem();
  [[nodiscard]] NewtonOptions newton_options() const;
  void begin(const BodyState& state, std::span<const PlenumControl> controls, std::span<const double> first_pressures);
  [[nodiscard]] EquilibriumReport report_of(const NewtonOutcome& outcome) const;
  [[nodiscard]] std::string reason_of(const NewtonOutcome& outcome) const;
  [[nodiscard]] Loads loads(std::span<const double> pressures) const { return {pressures, dead_load_factor_, motions_}; }
  void unpack(Vec x, std::vector<double>& displacements, std::vector<double>& pressures) const;
  void pack(const BodyState& state, Vec x) const;
  bool evaluate(Vec x);
  bool compute_residual(Vec x, Vec residual);
  bool close_plena();
  void measure_plates();
  void assemble_stiffness(std::span<const double> displacements, std::span<const double> pressures);
  bool prepare_stiffness(Vec x);
  bool solve_linear(Vec right_hand_side, Vec solution);
  std::vector<double> eliminate_plena();
  [[nodiscard]] double times_gradient(std::size_t plenum, Vec vector) const;
  void carry_along(Vec trial, Vec from, double length) const;
  void follow_step(Vec from);
  [[nodiscard]] NewtonVerdict judge();
  [[nodiscard]] bool is_free(std::size_t plenum) const { return !std::holds_alternative<PressureControl>(controls_[plenum]); }
  [[nodiscard]] std::size_t owned_components() const { return 3 * static_cast<std::size_t>(space_.owned_count); }
  [[nodiscard]] double norm_of_owned(std::span<const double> field) const;

  const Space& space_;
  const Body& body_;
  EquilibriumOptions options_;
  int rank_;
  Assembly assembly_;
  LinearSolver linear_;
  /// Vectors of the unknowns hold the owned displacement components and, on the first rank, the pressures of all plena; those
  /// that are given have the residual zero and do not change.
  VectorHandle unknown_;
  NewtonSolver newton_;
  VectorHandle displacement_part_;
  VectorHandle particular_;
  std::vector<VectorHandle> influences_;  ///< K^-1 dV/du of each plenum that is free
  std::vector<PlateMotion> motions_;
  std::vector<PlateComponent> plate_components_;
  bool is_held_;  ///< MUMPS does not notice a singular stiffness
  double diameter_m_ = 0.0;
  double floor_N_ = 0.0;
  double dead_load_norm_N_ = 0.0;
  double dead_load_factor_ = 1.0;

  // Of the running search.
  std::span<const PlenumControl> controls_;
  std::span<const double> first_pressures_;  ///< until the first stiffness has been assembled
  int growing_steps_ = 0;
  double residual_before_N_ = 0.0;
  double largest_step_m_ = 0.0;
  bool runs_away_ = false;

  // Of the state that was evaluated last.
  std::vector<double> displacements_;
  std::vector<double> pressures_;
  std::vector<double> residual_;
  std::vector<std::vector<double>> volume_gradients_;
  std::vector<PlenumClosure> closures_;
  BodyTotals totals_;
  double residual_N_ = 0.0;
  double reference_N_ = 0.0;
  double plate_distance_m_ = 0.0;  ///< largest distance of a held component from where its plate carries it

  // Of the stiffness that is factorised.
  std::vector<std::vector<double>> gradients_of_factor_;
  std::vector<double> plate_step_m_;        ///< per local component, minus what is left of the way
  std::vector<double> plate_step_force_N_;  ///< K times it
};

}  // namespace menger::fem
