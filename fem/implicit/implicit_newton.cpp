#include "fem/implicit/implicit_newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace menger::fem {
namespace {

constexpr int most_iterations = 20;
/// A factorisation costs about as much as eight steps: steps that shrink by less are not worth going on with it.
constexpr double slow_rate = 0.6;
constexpr double rate_of_new_factor = 0.5;  // not known yet; the second step says
constexpr int most_trials = 6;
constexpr double tolerable_overshoot = 0.5;

/// Lengths of a step between which y . R changes its sign, and its values there.
struct Bracket {
  double at_low = 0.0;  ///< > 0, at length 0
  double high = 1.0;
  double at_high = 0.0;  ///< < 0

  /// By false position, inside by a tenth.
  [[nodiscard]] double guess() const { return high * std::clamp(at_low / (at_low - at_high), 0.1, 0.9); }
};

}  // namespace

ImplicitNewton::ImplicitNewton(const Assembly& assembly, const LinearOptions& options, NodalEquation equation)
    : assembly_(assembly), equation_(std::move(equation)), linear_(assembly, options) {
  unknown_ = linear_.make_vector();
  residual_vector_ = linear_.make_vector();
  residual_.resize(3 * assembly.space().positions.size());
  change_.resize(residual_.size());
  petsc(SNESCreate(assembly.space().communicator, snes_.receive()));
  petsc(SNESSetType(snes_, SNESNEWTONLS));
  petsc(SNESSetFunction(snes_, residual_vector_, compute_function, this));
  petsc(SNESSetJacobian(snes_, linear_.matrix(), linear_.matrix(), compute_jacobian, this));
  petsc(SNESSetConvergenceTest(snes_, test_convergence, this, nullptr));
  petsc(SNESSetTolerances(snes_, 0.0, 0.0, 0.0, most_iterations, 1'000'000));
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
  petsc(PCShellSetApply(preconditioner, apply_factor));
}

void ImplicitNewton::unpack(Vec x, std::vector<double>& u) const {
  const double* data = nullptr;
  petsc(VecGetArrayRead(x, &data));
  u.resize(residual_.size());
  std::copy_n(data, 3 * assembly_.space().owned_count, u.begin());
  petsc(VecRestoreArrayRead(x, &data));
  assembly_.exchange().update_ghosts(u);
}

void ImplicitNewton::pack(std::span<const double> u, Vec x) const {
  double* data = nullptr;
  petsc(VecGetArrayWrite(x, &data));
  std::copy_n(u.begin(), 3 * assembly_.space().owned_count, data);
  petsc(VecRestoreArrayWrite(x, &data));
}

/// PETSc gives up at the first number that is none; a state without an answer is dealt with in the search along the step.
PetscErrorCode ImplicitNewton::compute_function(SNES, Vec x, Vec f, void* context) {
  auto& self = *static_cast<ImplicitNewton*>(context);
  self.unpack(x, self.u_);
  std::fill(self.residual_.begin(), self.residual_.end(), 0.0);
  self.has_answer_ = self.equation_.residual(self.u_, self.residual_);
  if (!self.has_answer_) std::fill(self.residual_.begin(), self.residual_.end(), 0.0);
  self.pack(self.residual_, f);
  return 0;
}

bool ImplicitNewton::wants_factorisation() const {
  if (is_stale_ || !has_factor_) return true;
  return steps_with_factor_ == 0 ? rate_ > slow_rate : this_rate_ > slow_rate && steps_with_factor_ > 1;
}

PetscErrorCode ImplicitNewton::compute_jacobian(SNES, Vec x, Mat, Mat, void* context) {
  auto& self = *static_cast<ImplicitNewton*>(context);
  if (!self.wants_factorisation()) return 0;
  self.unpack(x, self.u_);
  self.equation_.matrix(self.u_, self.linear_.matrix());
  self.has_factor_ = self.linear_.prepare();
  self.singular_ = !self.has_factor_;
  self.is_stale_ = false;
  self.rate_ = rate_of_new_factor;
  self.this_rate_ = 0.0;
  self.steps_with_factor_ = 0;
  return 0;
}

/// Goes along a step y from x to where y . R hardly has the sign any more that it had at x.
void ImplicitNewton::take_step(SNESLineSearch line_search) {
  Vec x = nullptr;
  Vec f = nullptr;
  Vec y = nullptr;
  Vec trial = nullptr;
  Vec trial_f = nullptr;
  petsc(SNESLineSearchGetVecs(line_search, &x, &f, &y, &trial, &trial_f));
  double at_start = 0.0;
  petsc(VecDot(y, f, &at_start));
  Bracket bracket{.at_low = at_start};
  double length = 1.0;
  for (int n = 0; n < most_trials; ++n) {
    petsc(VecWAXPY(trial, -length, y, x));
    petsc(SNESComputeFunction(snes_, trial, trial_f));
    double at_length = -at_start;  // where there is no answer: half as far next
    if (has_answer_) {
      petsc(VecDot(y, trial_f, &at_length));
      if (at_start <= 0.0 || at_length >= -tolerable_overshoot * at_start) break;
    }
    bracket.high = length;
    bracket.at_high = at_length;
    length = bracket.guess();
  }
  if (singular_ || !has_answer_) {
    petsc(SNESLineSearchSetReason(line_search, SNES_LINESEARCH_FAILED_REDUCT));
    return;
  }
  petsc(VecCopy(trial, x));
  petsc(VecCopy(trial_f, f));
  unpack(y, change_);
  const double before = step_size_;
  step_size_ = equation_.size(change_);
  if (++steps_with_factor_ > 1) this_rate_ = std::max(0.3 * this_rate_, step_size_ / before);
  petsc(SNESLineSearchSetNorms(line_search, 1.0, 1.0, 1.0));
  petsc(SNESLineSearchSetReason(line_search, SNES_LINESEARCH_SUCCEEDED));
}

PetscErrorCode ImplicitNewton::search_line(SNESLineSearch line_search, void* context) {
  static_cast<ImplicitNewton*>(context)->take_step(line_search);
  return 0;
}

PetscErrorCode ImplicitNewton::apply_factor(PC preconditioner, Vec right_hand_side, Vec solution) {
  void* context = nullptr;
  petsc(PCShellGetContext(preconditioner, &context));
  auto& self = *static_cast<ImplicitNewton*>(context);
  if (self.singular_ || !self.linear_.solve(right_hand_side, solution)) {
    self.singular_ = true;
    petsc(VecZeroEntries(solution));
  }
  return 0;
}

SNESConvergedReason ImplicitNewton::judge(PetscInt iteration) {
  if (singular_) return SNES_DIVERGED_LINEAR_SOLVE;
  if (!has_answer_) return SNES_DIVERGED_FUNCTION_DOMAIN;
  if (iteration == 0) return SNES_CONVERGED_ITERATING;
  const double rate = this_rate_ > 0.0 ? this_rate_ : std::max(rate_, 0.1);
  const double left = rate < 0.9 ? step_size_ * rate / (1.0 - rate) : 10.0 * step_size_;
  if (left <= tolerance_ && equation_.is_balanced(residual_)) return SNES_CONVERGED_SNORM_RELATIVE;
  return SNES_CONVERGED_ITERATING;
}

PetscErrorCode ImplicitNewton::test_convergence(SNES, PetscInt iteration, PetscReal, PetscReal, PetscReal,
                                                SNESConvergedReason* reason, void* context) {
  *reason = static_cast<ImplicitNewton*>(context)->judge(iteration);
  return 0;
}

NewtonOutcome ImplicitNewton::solve(std::vector<double>& u, double tolerance) {
  tolerance_ = tolerance;
  singular_ = false;
  this_rate_ = 0.0;
  steps_with_factor_ = 0;
  pack(u, unknown_);
  petsc(SNESSolve(snes_, nullptr, unknown_));
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  PetscInt iterations = 0;
  petsc(SNESGetConvergedReason(snes_, &reason));
  petsc(SNESGetIterationNumber(snes_, &iterations));
  if (this_rate_ > 0.0) rate_ = this_rate_;
  NewtonOutcome outcome;
  outcome.iterations = static_cast<int>(iterations);
  if (reason > 0) {
    outcome.kind = NewtonOutcome::Kind::found;
    unpack(unknown_, u);
  } else {
    is_stale_ = true;
    if (singular_) outcome.kind = NewtonOutcome::Kind::singular;
    if (!has_answer_) outcome.kind = NewtonOutcome::Kind::no_answer;
  }
  return outcome;
}

}  // namespace menger::fem
