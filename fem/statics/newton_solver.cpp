#include "fem/statics/newton_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/process/interrupt.h"

namespace menger::fem {
namespace {

constexpr double rate_of_new_tangent = 0.5;  // assumed until the second step measures it

/// A bracket of the step length: y . R changes its sign between length 0 and `high`.
struct Bracket {
  double at_low = 0.0;  ///< > 0, at length 0
  double high = 1.0;
  double at_high = 0.0;  ///< < 0

  /// The next length by false position, kept a tenth of the interval away from its ends.
  [[nodiscard]] double guess() const { return high * std::clamp(at_low / (at_low - at_high), 0.1, 0.9); }
};

/// The vectors of a line search; PETSc owns them.
struct StepVectors {
  explicit StepVectors(SNESLineSearch line_search) { petsc(SNESLineSearchGetVecs(line_search, &x, &f, &y, &trial, &trial_f)); }
  Vec x = nullptr;  ///< the step goes from x to x - length y
  Vec f = nullptr;
  Vec y = nullptr;
  Vec trial = nullptr;
  Vec trial_f = nullptr;
};

/// PETSc has no reason for a stop from outside. This one means that its limit of evaluations was reached, which cannot happen
/// here.
constexpr SNESConvergedReason stopped_from_outside = SNES_DIVERGED_FUNCTION_COUNT;

NewtonEnd end_of(SNESConvergedReason reason) {
  if (reason > 0) return NewtonEnd::solved;
  switch (reason) {
    case stopped_from_outside:
      return NewtonEnd::stopped;
    case SNES_DIVERGED_FUNCTION_DOMAIN:
    case SNES_DIVERGED_FNORM_NAN:
    case SNES_DIVERGED_LINE_SEARCH:
      return NewtonEnd::no_residual;
    case SNES_DIVERGED_LINEAR_SOLVE:
      return NewtonEnd::linear_failure;
    case SNES_DIVERGED_DTOL:
      return NewtonEnd::diverging;
    default:
      return NewtonEnd::too_many_iterations;
  }
}

}  // namespace

io::RunStatus NewtonOutcome::status() const {
  switch (end) {
    case NewtonEnd::solved:
      return io::RunStatus::completed;
    case NewtonEnd::no_residual:
      return io::RunStatus::inverted_element;
    case NewtonEnd::stopped:
      return io::RunStatus::stopped;
    default:
      return io::RunStatus::not_converged;
  }
}

bool is_told_to_stop(const std::atomic<bool>* stop, MPI_Comm communicator) {
  if (stop == nullptr) return false;
  int stops = *stop ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &stops, 1, MPI_INT, MPI_MAX, communicator);
  if (stops != 0) io::come_to_stop();
  return stops != 0;
}

NewtonSolver::NewtonSolver(Vec prototype, NewtonProblem problem, NewtonOptions options)
    : problem_(std::move(problem)),
      options_(std::move(options)),
      communicator_(PetscObjectComm(reinterpret_cast<PetscObject>(prototype))),
      rate_(rate_of_new_tangent) {
  petsc(VecDuplicate(prototype, residual_.receive()));
  create();
}

void NewtonSolver::create() {
  PetscInt here = 0;
  petsc(VecGetLocalSize(residual_, &here));
  // SNES and KSP need a matrix object; nothing multiplies with it.
  petsc(MatCreateShell(communicator_, here, here, PETSC_DETERMINE, PETSC_DETERMINE, this, shell_.receive()));
  petsc(SNESCreate(communicator_, snes_.receive()));
  petsc(SNESSetType(snes_, SNESNEWTONLS));
  petsc(SNESSetFunction(snes_, residual_, compute_function, this));
  petsc(SNESSetJacobian(snes_, shell_, shell_, compute_jacobian, this));
  petsc(SNESSetConvergenceTest(snes_, test_convergence, this, nullptr));
  petsc(SNESSetTolerances(snes_, 0.0, 0.0, 0.0, options_.most_iterations, std::numeric_limits<PetscInt>::max()));
  SNESLineSearch line_search = nullptr;
  petsc(SNESGetLineSearch(snes_, &line_search));
  petsc(SNESLineSearchSetType(line_search, SNESLINESEARCHSHELL));
  petsc(SNESLineSearchShellSetUserFunc(line_search, search_line, this));
  KSP solver = nullptr;
  petsc(SNESGetKSP(snes_, &solver));
  petsc(KSPSetType(solver, KSPPREONLY));
  PC preconditioner = nullptr;
  petsc(KSPGetPC(solver, &preconditioner));
  petsc(PCSetType(preconditioner, PCSHELL));
  petsc(PCShellSetContext(preconditioner, this));
  petsc(PCShellSetApply(preconditioner, apply_inverse));
}

void NewtonSolver::begin() {
  if (std::holds_alternative<ReuseWhileResidualFalls>(options_.reuse)) is_stale_ = true;
  reuses_ = false;
  this_rate_ = 0.0;
  steps_with_tangent_ = 0;
}

NewtonOutcome NewtonSolver::solve(Vec x, const std::atomic<bool>* stop) {
  stop_ = stop;
  begin();
  const int earlier_tangents = tangents_;
  petsc(SNESSolve(snes_, nullptr, x));
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  PetscInt iterations = 0;
  petsc(SNESGetConvergedReason(snes_, &reason));
  petsc(SNESGetIterationNumber(snes_, &iterations));
  if (this_rate_ > 0.0) rate_ = this_rate_;
  if (reason < 0) is_stale_ = true;
  return {end_of(reason), static_cast<int>(iterations), tangents_ - earlier_tangents};
}

/// PETSc stops at the first number that is not finite. A state without a residual therefore gets zeros here, and the line search
/// handles it.
PetscErrorCode NewtonSolver::compute_function(SNES, Vec x, Vec f, void* context) {
  auto& self = *static_cast<NewtonSolver*>(context);
  self.has_residual_ = self.problem_.residual(x, f);
  if (self.has_residual_) {
    double norm = 0.0;
    petsc(VecNorm(f, NORM_2, &norm));
    self.has_residual_ = std::isfinite(norm);
  }
  if (!self.has_residual_) petsc(VecZeroEntries(f));
  return 0;
}

bool NewtonSolver::wants_tangent() {
  if (const auto* rule = std::get_if<ReuseWhileResidualFalls>(&options_.reuse)) {
    const double residual = rule->residual_size();
    const double reduction = reuses_ ? rule->lasting_reduction : rule->first_reduction;
    reuses_ = !is_stale_ && residual < reduction * previous_residual_;
    previous_residual_ = residual;
    return !reuses_;
  }
  if (is_stale_) return true;
  const double slowest = std::get<ReuseWhileStepsShrink>(options_.reuse).slowest_rate;
  return steps_with_tangent_ == 0 ? rate_ > slowest : this_rate_ > slowest && steps_with_tangent_ > 1;
}

PetscErrorCode NewtonSolver::compute_jacobian(SNES, Vec x, Mat, Mat, void* context) {
  auto& self = *static_cast<NewtonSolver*>(context);
  if (!self.wants_tangent()) return 0;
  ++self.tangents_;
  self.is_stale_ = !self.problem_.prepare_tangent(x);
  self.rate_ = rate_of_new_tangent;
  self.this_rate_ = 0.0;
  self.steps_with_tangent_ = 0;
  return 0;
}

PetscErrorCode NewtonSolver::apply_inverse(PC preconditioner, Vec right_hand_side, Vec solution) {
  void* context = nullptr;
  petsc(PCShellGetContext(preconditioner, &context));
  auto& self = *static_cast<NewtonSolver*>(context);
  const bool is_solved = !self.is_stale_ && self.problem_.solve_tangent(right_hand_side, solution);
  if (!is_solved) petsc(VecZeroEntries(solution));
  petsc(PCSetFailedReason(preconditioner, is_solved ? PC_NOERROR : PC_SUBPC_ERROR));
  return 0;
}

PetscErrorCode NewtonSolver::search_line(SNESLineSearch line_search, void* context) {
  static_cast<NewtonSolver*>(context)->take_step(line_search);
  return 0;
}

void NewtonSolver::take_step(SNESLineSearch line_search) {
  if (const auto* halved = std::get_if<HalvedSteps>(&options_.steps)) {
    go_to_domain(line_search, *halved);
  } else {
    go_to_minimum(line_search, std::get<BracketedSteps>(options_.steps));
  }
  if (!has_residual_) {
    petsc(SNESLineSearchSetReason(line_search, SNES_LINESEARCH_FAILED_DOMAIN));
    petsc(SNESSetConvergedReason(snes_, SNES_DIVERGED_FUNCTION_DOMAIN));
    return;
  }
  const StepVectors step(line_search);
  if (problem_.follow_step) problem_.follow_step(step.x, step.trial);
  petsc(VecCopy(step.trial, step.x));
  petsc(VecCopy(step.trial_f, step.f));
  measure_step(step.y);
  petsc(SNESLineSearchSetNorms(line_search, 1.0, 1.0, 1.0));  // the problem decides on convergence, not SNES
  petsc(SNESLineSearchSetReason(line_search, SNES_LINESEARCH_SUCCEEDED));
}

void NewtonSolver::evaluate_trial(SNESLineSearch line_search, double length) {
  length_ = length;
  const StepVectors step(line_search);
  petsc(VecWAXPY(step.trial, -length, step.y, step.x));
  if (problem_.correct_trial) problem_.correct_trial(step.trial, step.x, length);
  petsc(SNESComputeFunction(snes_, step.trial, step.trial_f));
}

void NewtonSolver::go_to_domain(SNESLineSearch line_search, const HalvedSteps& rule) {
  for (double length = 1.0; length >= rule.shortest; length *= 0.5) {
    evaluate_trial(line_search, length);
    if (has_residual_) return;
  }
}

void NewtonSolver::go_to_minimum(SNESLineSearch line_search, const BracketedSteps& rule) {
  const StepVectors step(line_search);
  double at_start = 0.0;
  petsc(VecDot(step.y, step.f, &at_start));
  Bracket bracket{.at_low = at_start};
  double length = 1.0;
  for (int n = 0; n < rule.most_trials; ++n) {
    evaluate_trial(line_search, length);
    double at_trial = -at_start;  // without a residual: try half the length next
    if (has_residual_) {
      petsc(VecDot(step.y, step.trial_f, &at_trial));
      if (at_start <= 0.0 || at_trial >= -rule.tolerable_overshoot * at_start) return;
    }
    bracket.high = length;
    bracket.at_high = at_trial;
    length = bracket.guess();
  }
}

void NewtonSolver::measure_step(Vec step) {
  const auto* rule = std::get_if<ReuseWhileStepsShrink>(&options_.reuse);
  if (rule == nullptr) return;
  const double before = step_size_;
  step_size_ = rule->step_size(step);
  if (++steps_with_tangent_ > 1) this_rate_ = std::max(0.3 * this_rate_, step_size_ / before);
}

NewtonIterate NewtonSolver::iterate(int steps) const {
  NewtonIterate result{.steps = steps};
  if (steps == 0 || !std::holds_alternative<ReuseWhileStepsShrink>(options_.reuse)) return result;
  const double rate = this_rate_ > 0.0 ? this_rate_ : std::max(rate_, 0.1);
  result.distance = rate < 0.9 ? step_size_ * rate / (1.0 - rate) : 10.0 * step_size_;
  result.distance = std::max(result.distance, (1.0 - length_) * step_size_);  // what a shortened step leaves
  return result;
}

SNESConvergedReason NewtonSolver::check(int steps) const {
  if (is_told_to_stop(stop_, communicator_)) return stopped_from_outside;
  if (!has_residual_) return SNES_DIVERGED_FUNCTION_DOMAIN;
  switch (problem_.check(iterate(steps))) {
    case NewtonVerdict::solved:
      return SNES_CONVERGED_FNORM_ABS;
    case NewtonVerdict::diverging:
      return SNES_DIVERGED_DTOL;
    default:
      return SNES_CONVERGED_ITERATING;
  }
}

PetscErrorCode NewtonSolver::test_convergence(SNES, PetscInt iteration, PetscReal, PetscReal, PetscReal,
                                              SNESConvergedReason* reason, void* context) {
  *reason = static_cast<NewtonSolver*>(context)->check(static_cast<int>(iteration));
  return 0;
}

}  // namespace menger::fem
