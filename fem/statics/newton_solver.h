#pragma once

#include <petscsnes.h>

#include <atomic>
#include <functional>
#include <limits>
#include <variant>

#include "fem/space/petsc_handle.h"
#include "io/text/run_status.h"

namespace menger::fem {

/// The progress of Newton's method after some steps.
struct NewtonIterate {
  int steps = 0;
  /// Estimate of the distance to the solution, in the norm of the steps. Infinite before the first step and where the rule of
  /// reuse does not measure steps, see ReuseWhileStepsShrink.
  double distance = std::numeric_limits<double>::infinity();
};

enum class NewtonVerdict { go_on, solved, diverging };

/// The equation R(x) = 0 and the functions that define it. They are collective and return the same on all ranks. Vectors have the
/// layout of the solver's prototype.
struct NewtonProblem {
  /// Computes R(x). @return whether it exists; an R with a number that is not finite does not count as existing
  std::function<bool(Vec x, Vec residual)> residual;
  /// Prepares solutions with dR/dx at x, or with an approximation of it: a factorisation or a preconditioner. @return whether it
  /// succeeded
  std::function<bool(Vec x)> prepare_tangent;
  /// Solves y = (dR/dx)^-1 b with the last preparation. @return whether a solution was found
  std::function<bool(Vec b, Vec y)> solve_tangent;
  /// Decides whether to go on. Called at the start and after each step, when R of the state has just been evaluated.
  std::function<NewtonVerdict(const NewtonIterate& iterate)> check;
  /// May correct a trial state from - length y before its residual is evaluated.
  std::function<void(Vec trial, Vec from, double length)> correct_trial{};
  /// Called after each step that is taken, when R(to) has just been evaluated.
  std::function<void(Vec from, Vec to)> follow_step{};
};

/// Full Newton steps, halved as often as needed to reach a state that has a residual.
struct HalvedSteps {
  double shortest = 1.0 / 64;  ///< shortest part of the full step
};

/// Full Newton steps. A step that goes far beyond the minimum of the energy is shortened by false position.
///
/// The residual R is the gradient of the energy, so with the step y the slope along the step is y . R. A step goes too far if the
/// slope has changed its sign at the end and is larger there than `tolerable_overshoot` times that at the start. This happens,
/// for example, where two nodes stick in turn.
struct BracketedSteps {
  int most_trials = 6;
  double tolerable_overshoot = 0.5;
};

/// A rule that reuses a tangent within one solve. It is reused if, in the first step with it, the residual fell to less than the
/// first factor of its former size. After that it is reused as long as each step reduces the residual by the second factor. The
/// cost of a few solutions replaces that of a factorisation.
struct ReuseWhileResidualFalls {
  std::function<double()> residual_size;  ///< size of the residual at the state that was evaluated last
  double first_reduction = 0.02;
  double lasting_reduction = 0.2;
};

/// A rule that reuses a tangent, also in later solves, as long as the ratio of two successive steps is at most `slowest_rate`. It
/// suits many equations, each near the last. After a step of size d the remaining distance is estimated as d r / (1 - r), where r
/// is the ratio of the last two steps. For the first step of a solve r is that of the last solve.
struct ReuseWhileStepsShrink {
  std::function<double(Vec step)> step_size;  ///< a norm
  double slowest_rate = 0.6;                  ///< chosen so because a factorisation costs about as much as eight steps
};

struct NewtonOptions {
  int most_iterations = 25;
  std::variant<HalvedSteps, BracketedSteps> steps;
  std::variant<ReuseWhileResidualFalls, ReuseWhileStepsShrink> reuse;
};

/// The reason why Newton's method ended.
enum class NewtonEnd {
  solved,
  too_many_iterations,
  no_residual,     ///< none at the start, or none along a step, however short
  linear_failure,  ///< the tangent could not be prepared, or no linear solution was found
  diverging,       ///< decided by NewtonProblem::check
  stopped
};

struct NewtonOutcome {
  NewtonEnd end = NewtonEnd::too_many_iterations;
  int iterations = 0;  ///< steps taken
  int tangents = 0;    ///< tangents prepared in this solve

  /// completed, inverted_element (no residual), stopped or not_converged.
  [[nodiscard]] io::RunStatus status() const;
};

/// Returns whether any rank has been asked to stop; the same on all ranks. If so, the program has come to a stopping point
/// (io::come_to_stop). @param stop or nullptr, on all ranks alike
bool is_told_to_stop(const std::atomic<bool>* stop, MPI_Comm communicator);

/// Newton's method with PETSc's SNES. All nonlinear equations of the finite elements are solved by it.
class NewtonSolver {
 public:
  /// @param prototype a vector of the unknowns
  NewtonSolver(Vec prototype, NewtonProblem problem, NewtonOptions options);
  NewtonSolver(const NewtonSolver&) = delete;
  NewtonSolver& operator=(const NewtonSolver&) = delete;

  /// Improves x until `check` returns `solved`. Otherwise x is left at the last step. Collective.
  /// @param stop checked before the start and after each step
  [[nodiscard]] NewtonOutcome solve(Vec x, const std::atomic<bool>* stop = nullptr);

  /// Makes the next step prepare a new tangent.
  void forget_tangent() { is_stale_ = true; }

  /// Returns the number of tangents that all solves have prepared.
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
  [[nodiscard]] SNESConvergedReason check(int steps) const;

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
  double this_rate_ = 0.0;  ///< of this solve; 0: not known yet
  double step_size_ = 0.0;
  double length_ = 1.0;         ///< of the last trial, as a part of the step
  int steps_with_tangent_ = 0;  ///< in this solve
};

}  // namespace menger::fem
