#pragma once

#include <petscsnes.h>

#include <atomic>
#include <functional>
#include <limits>
#include <variant>

#include "fem/space/petsc_handle.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// Where Newton's method stands after some steps.
struct NewtonIterate {
  int steps = 0;
  /// Estimate of the distance to the solution, in the size of steps; infinite before the first step and where the rule of reuse
  /// does not measure steps, see ReuseWhileStepsShrink.
  double distance = std::numeric_limits<double>::infinity();
};

enum class NewtonVerdict { go_on, solved, diverging };

/// The equation R(x) = 0, and what only it knows. The functions are collective and return the same on all ranks; vectors have the
/// layout of the solver's prototype.
struct NewtonProblem {
  /// R(x). @return whether there is one; R counts as none, too, where a number of it is not finite
  std::function<bool(Vec x, Vec residual)> residual;
  /// Makes dR/dx at x, or something near it, ready for solutions: a factorisation, or a preconditioner. @return whether it could
  std::function<bool(Vec x)> prepare_tangent;
  /// y = (dR/dx)^-1 b with what was prepared last. @return whether a solution was found
  std::function<bool(Vec b, Vec y)> solve_tangent;
  /// Asked at the start and after each step, when R of the state has just been evaluated.
  std::function<NewtonVerdict(const NewtonIterate& iterate)> judge;
  /// May correct a trial state from - length y before its residual is evaluated.
  std::function<void(Vec trial, Vec from, double length)> correct_trial{};
  /// Told of each step that is taken, when R(to) has just been evaluated.
  std::function<void(Vec from, Vec to)> follow_step{};
};

/// Steps are full ones, halved as often as needed to reach a state that has a residual.
struct HalvedSteps {
  double shortest = 1.0 / 64;  ///< part of the full step
};

/// Full Newton steps, but a step that goes far beyond the minimum of the energy is shortened by false position.
///
/// With the step y and the residual R, the gradient of the energy, the slope along the step is y . R. A step goes too far if the
/// slope has changed its sign at the end and is larger there than `tolerable_overshoot` times that at the start, as where two
/// nodes stick by turns.
struct BracketedSteps {
  int most_trials = 6;
  double tolerable_overshoot = 0.5;
};

/// A tangent is used again within a solve if the residual fell at least by the first factor with it when it was new, and after
/// that as long as it falls by the second: the cost of a few solutions against that of a factorisation.
struct ReuseWhileResidualFalls {
  std::function<double()> residual_size;  ///< of the state that was evaluated last
  double first_reduction = 0.02;
  double lasting_reduction = 0.2;
};

/// A tangent is used again, also by the next solves, as long as the ratio of two steps is at most `slowest_rate`: for many
/// equations, each near the last. What is left after a step of size d is taken for d r / (1 - r), r being the ratio of the last
/// two; the first step is judged by the ratio of the last solve.
struct ReuseWhileStepsShrink {
  std::function<double(Vec step)> step_size;  ///< a norm
  double slowest_rate = 0.6;                  ///< a factorisation costs about as much as eight steps
};

struct NewtonOptions {
  int most_iterations = 25;
  std::variant<HalvedSteps, BracketedSteps> steps;
  std::variant<ReuseWhileResidualFalls, ReuseWhileStepsShrink> reuse;
};

/// Why Newton's method ended.
enum class NewtonEnd {
  solved,
  too_many_iterations,
  no_residual,     ///< none at the start, or none along a step, however short
  linear_failure,  ///< the tangent could not be prepared, or a linear system with it not be solved
  diverging,       ///< so the problem judged
  stopped
};

struct NewtonOutcome {
  NewtonEnd end = NewtonEnd::too_many_iterations;
  int iterations = 0;  ///< steps taken
  int tangents = 0;    ///< prepared in this solve

  /// completed, inverted_element (no residual), stopped or not_converged.
  [[nodiscard]] io::RunStatus status() const;
};

/// Whether any rank has been told to stop; the same on all ranks. @param stop or nullptr, on all ranks alike
bool is_told_to_stop(const std::atomic<bool>* stop, MPI_Comm communicator);

/// Newton's method by PETSc's SNES: the one solver of nonlinear equations of the finite elements.
class NewtonSolver {
 public:
  /// @param prototype a vector of the unknowns
  NewtonSolver(Vec prototype, NewtonProblem problem, NewtonOptions options);
  NewtonSolver(const NewtonSolver&) = delete;
  NewtonSolver& operator=(const NewtonSolver&) = delete;

  /// Improves x until the problem judges it solved; otherwise x is left as the last step reached it. Collective.
  /// @param stop asked before the start and after each step
  [[nodiscard]] NewtonOutcome solve(Vec x, const std::atomic<bool>* stop = nullptr);

  /// The next step prepares a tangent of its own.
  void forget_tangent() { is_stale_ = true; }

  /// How many tangents were prepared by all solves.
  [[nodiscard]] int tangents() const { return tangents_; }

 private:
  static PetscErrorCode compute_function(SNES snes, Vec x, Vec f, void* context);
  static PetscErrorCode compute_jacobian(SNES snes, Vec x, Mat jacobian, Mat preconditioner, void* context);
  static PetscErrorCode apply_inverse(PC preconditioner, Vec right_hand_side, Vec solution);
  static PetscErrorCode search_line(SNESLineSearch line_search, void* context);
  static PetscErrorCode test_convergence(SNES snes, PetscInt iteration, PetscReal, PetscReal, PetscReal,
                                         SNESConvergedReason* reason, void* context);
  void create();
  void begin();
  [[nodiscard]] bool wants_tangent();
  void take_step(SNESLineSearch line_search);
  void evaluate_trial(SNESLineSearch line_search, double length);
  void go_to_domain(SNESLineSearch line_search, const HalvedSteps& rule);
  void go_to_minimum(SNESLineSearch line_search, const BracketedSteps& rule);
  void measure_step(Vec step);
  [[nodiscard]] NewtonIterate iterate(int steps) const;
  [[nodiscard]] SNESConvergedReason judge(int steps) const;

  NewtonProblem problem_;
  NewtonOptions options_;
  VectorHandle residual_;
  MatrixHandle shell_;
  NonlinearSolverHandle snes_;
  MPI_Comm communicator_;
  const std::atomic<bool>* stop_ = nullptr;
  int tangents_ = 0;
  bool has_residual_ = false;  ///< the state that was evaluated last
  bool is_stale_ = true;

  // ReuseWhileResidualFalls.
  bool reuses_ = false;
  double previous_residual_ = 0.0;

  // ReuseWhileStepsShrink.
  double rate_;             ///< of the last solve
  double this_rate_ = 0.0;  ///< of this one; 0: not known yet
  double step_size_ = 0.0;
  int steps_with_tangent_ = 0;  ///< in this solve
};

}  // namespace menger::fem
