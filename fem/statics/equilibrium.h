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

/// Tolerances and limits of one search for an equilibrium.
struct EquilibriumOptions {
  int largest_iteration_count = 25;
  /// The largest norm of the residual, divided by that of the loads. The loads are the pressure forces on components that are not
  /// held, the dead loads and the forces of the plates, and at least 1e-4 times shear modulus x length^2.
  double relative_force_tolerance = 1e-7;
  double relative_volume_tolerance = 1e-9;  ///< for a plenum under control by volume or gas
  double smallest_step_length = 1.0 / 64;   ///< shortest part of a Newton step that is tried to keep volume ratios positive
  bool predict_pressure = true;             ///< true: Newton's method of the three fields; false: of the displacements alone
  LinearOptions linear;
};

/// A state of a body; it need not be an equilibrium.
struct BodyState {
  std::vector<double> displacements_m;      ///< 3 per local node, ghosts up to date
  std::vector<double> plenum_pressures_Pa;  ///< gauge
  std::vector<double>
      /// At the quadrature points, in the order of ElementGroups. Empty: those that follow from the displacements.
      element_pressures_Pa;
};

/// The outcome of a search for an equilibrium.
struct EquilibriumReport {
  io::RunStatus status = io::RunStatus::not_converged;  ///< completed, not_converged, inverted_element or stopped
  std::string reason;                                   ///< why it is not completed, for the user
  int iterations = 0;
  int factorisations = 0;
  double residual_N = 0.0;
  double reference_force_N = 0.0;
  BodyTotals totals;                      ///< of the last state
  std::vector<double> plenum_volumes_m3;  ///< of the modelled part of each plenum
  std::optional<int> negative_pivots;     ///< of the last factorisation; > 0: unstable at constant pressures
};

/// Finds equilibria of a body: states where the residual of Assembly is zero and the equation of every plenum holds.
///
/// It uses Newton's method (see NewtonSolver). The unknowns are the displacements and the pressures of plena that are not given.
/// The pressures are eliminated from the bordered system with the factorisation of the stiffness. For thin walls, whose pressures
/// do work on other volumes than those that are controlled (see PressedWalls), this system is not symmetric. Steps are full. They
/// are shortened only where volume ratios would not stay positive. The norm of the residual does not control the steps, because
/// it may grow by orders of magnitude on the way to a bent wall. A factorisation is reused as long as the residual falls fast
/// with it.
///
/// Plates add one linear equation per held component: the component is where its plate carries it. The first full step therefore
/// satisfies these equations exactly, and the nodes inside the body follow by the stiffness at the start of the step. A shortened
/// step carries the plate part of the distance, and the next steps the rest.
class Equilibrium {
 public:
  /// Keeps references to space and body.
  Equilibrium(const Space& space, const Body& body, const EquilibriumOptions& options);
  Equilibrium(const Equilibrium&) = delete;
  Equilibrium& operator=(const Equilibrium&) = delete;

  /// Returns the state at rest: displacements and pressures are zero.
  [[nodiscard]] BodyState rest() const;

  /// Improves a state until it is an equilibrium. If none is found, the state is the last one of the search.
  /// @param controls one per plenum
  /// @param pressures_of_first_stiffness pressures, one per plenum, with which the first iteration is linearised. If the state is
  /// still the last equilibrium, give that one's pressures. Empty: those of the state.
  EquilibriumReport solve(BodyState& state, std::span<const PlenumControl> controls, double dead_load_factor,
                          std::span<const double> pressures_of_first_stiffness = {}, const std::atomic<bool>* stop = nullptr);

  /// Sets the positions of the plates for the next searches, one motion per plate (asserts). Before the first call they are at
  /// rest.
  void move_plates(std::span<const PlateMotion> motions);

  /// Returns the number of negative eigenvalues of the stiffness at a state and its pressures: 0 where the state is stable under
  /// them. It needs a factorisation; nothing with the iterative method.
  std::optional<int> count_negative_pivots(const BodyState& state, double dead_load_factor);

  /// Returns the totals of a body in a state, which need not be an equilibrium: energies, volumes, ground force and work of the
  /// dead loads (see BodyTotals). They follow from the displacements of the state alone. The reactions of plates are left empty.
  BodyTotals totals(const BodyState& state);
  /// Returns the volume of each plenum, m^3: the sum of the volumes of its chambers in `totals`.
  [[nodiscard]] std::vector<double> plenum_volumes(const BodyTotals& totals) const;

  /// Returns the method for linear systems that was chosen, and why.
  [[nodiscard]] const LinearChoice& linear_choice() const { return linear_.choice(); }

  [[nodiscard]] Assembly& assembly() { return assembly_; }
  [[nodiscard]] const Space& space() const { return space_; }
  [[nodiscard]] const Body& body() const { return body_; }

 private:
  /// A component that a plate holds: its index among the owned ones, and its imposed displacement.
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
  [[nodiscard]] NewtonVerdict check();
  [[nodiscard]] bool is_free(std::size_t plenum) const { return !std::holds_alternative<PressureControl>(controls_[plenum]); }
  [[nodiscard]] std::size_t owned_components() const { return 3 * static_cast<std::size_t>(space_.owned_count); }
  [[nodiscard]] double norm_of_owned(std::span<const double> field) const;

  const Space& space_;
  const Body& body_;
  EquilibriumOptions options_;
  int rank_;
  Assembly assembly_;
  LinearSolver linear_;
  /// Vectors of the unknowns hold the owned displacement components and, on the first rank, the pressures of all plena. Given
  /// pressures have residual zero and do not change.
  VectorHandle unknown_;
  NewtonSolver newton_;
  VectorHandle displacement_part_;
  VectorHandle particular_;
  std::vector<VectorHandle> influences_;  ///< K^-1 dV/du of each plenum that is free
  std::vector<PlateMotion> motions_;
  std::vector<PlateComponent> plate_components_;
  bool is_held_;  ///< needed because MUMPS does not notice a singular stiffness
  double diameter_m_ = 0.0;
  double floor_N_ = 0.0;
  double dead_load_norm_N_ = 0.0;
  double dead_load_factor_ = 1.0;

  // Of the running search.
  std::span<const PlenumControl> controls_;
  std::span<const double> first_pressures_;  ///< empty once the first stiffness has been assembled
  int growing_steps_ = 0;
  double residual_before_N_ = 0.0;
  double largest_step_m_ = 0.0;
  bool runs_away_ = false;

  // Of the state that was evaluated last.
  std::vector<double> displacements_;
  std::vector<double> pressures_;
  std::vector<double> residual_;
  std::vector<std::vector<double>> volume_gradients_;  ///< of the work volumes
  std::vector<PlenumClosure> closures_;
  BodyTotals totals_;
  double residual_N_ = 0.0;
  double reference_N_ = 0.0;
  double plate_distance_m_ = 0.0;  ///< largest distance of a held component from its imposed position

  // Of the stiffness that is factorised; the gradients are those of the chambers' volumes.
  std::vector<std::vector<double>> gradients_of_factor_;
  std::vector<double> plate_step_m_;        ///< per local component, minus the rest of the distance to the imposed position
  std::vector<double> plate_step_force_N_;  ///< K times plate_step_m_
};

}  // namespace menger::fem
