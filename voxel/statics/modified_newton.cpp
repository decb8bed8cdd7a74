#include "voxel/statics/modified_newton.h"

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "io/sundials/handle.h"
#include "voxel/statics/tangent_factors.h"

namespace menger::voxel {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Size of rounding errors. At this size the residual stops falling, and steps have no meaning.
constexpr double rounding = 1e-13;

/// Largest fraction of the residual that a step may leave if its tangent is to be kept.
constexpr double fast = 0.2;

/// KINSOL halves a step if the system function asks for it, but evaluates five times at most.
constexpr int most_halvings = 4;

/// Return values of the functions that KINSOL calls: done, or try again with a smaller step.
constexpr int accepted = 0;
constexpr int too_far = 1;

using View = Eigen::Map<Eigen::VectorXd>;

View view(N_Vector v) { return {N_VGetArrayPointer(v), static_cast<Eigen::Index>(N_VGetLength(v))}; }

/// The largest magnitude of the entries, infinite if one is not finite.
double size_of(const Equations::Values& values) {
  // maxCoeff ignores NaN; a sum does not.
  const double sum = values.cwiseAbs().sum();
  if (!std::isfinite(sum)) return infinity;
  return values.size() == 0 ? 0.0 : values.lpNorm<Eigen::Infinity>();
}

}  // namespace

/// The objects of KINSOL, the functions that it calls, and the data that these keep during a search.
struct ModifiedNewton::Solver {
  explicit Solver(Eigen::Index unknown_count);

  /// Runs one search. @param residual at x @return the largest residual where the search ends, infinite if a tangent was singular
  [[nodiscard]] double search(const Equations& of, Eigen::VectorXd& x, const Eigen::VectorXd& residual, double tolerance,
                              const NewtonOptions& options);

  static int evaluate(N_Vector x, N_Vector residual, void* solver);
  static int form_tangent(N_Vector x, N_Vector residual, SUNMatrix tangent, void* solver, N_Vector scratch1, N_Vector scratch2);
  static int factorise(SUNLinearSolver linear, SUNMatrix tangent);
  static int solve(SUNLinearSolver linear, SUNMatrix tangent, N_Vector step, N_Vector minus_residual, double tolerance);

  io::SundialsContext context = io::make_sundials_context();
  Eigen::VectorXd ones;
  io::SundialsVector scale;  ///< of unknowns and residuals: all ones
  io::SundialsMatrix matrix;
  io::SundialsLinearSolver linear;
  io::SundialsHandle<void*, KINFree> kinsol;

  const Equations* equations = nullptr;
  const Eigen::VectorXd* start = nullptr;  ///< the residual at the start, until KINSOL has asked for it
  double largest_step = infinity;

  const Eigen::SparseMatrix<double>* tangent = nullptr;  ///< the tangent that `matrix` represents
  TangentFactors factors;
  bool has_factors = false;
  bool is_new = false;   ///< whether the factors belong to the tangent where the next step begins
  bool was_old = false;  ///< whether the last step used older factors

  double size = infinity;         ///< of the residual evaluated last
  double size_before = infinity;  ///< of the residual where the last step began
  double norm_before = infinity;  ///< Euclidean norm of that residual
  int halvings_left = 0;          ///< for the last step

  std::size_t iterations = 0;
  std::size_t factorisations = 0;
};

ModifiedNewton::Solver::Solver(Eigen::Index unknown_count)
    : ones(Eigen::VectorXd::Ones(unknown_count)),
      scale(io::sundials_made<io::SundialsVector>(N_VMake_Serial(unknown_count, ones.data(), context.get()))),
      matrix(io::sundials_made<io::SundialsMatrix>(SUNMatNewEmpty(context.get()))),
      linear(io::sundials_made<io::SundialsLinearSolver>(SUNLinSolNewEmpty(context.get()))),
      kinsol(io::sundials_made<io::SundialsHandle<void*, KINFree>>(KINCreate(context.get()))) {
  matrix->content = this;
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->zero = [](SUNMatrix) { return SUNMAT_SUCCESS; };  // the function that forms a tangent starts from zero
  matrix->ops->destroy = SUNMatFreeEmpty;
  linear->content = this;
  linear->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  linear->ops->setup = factorise;
  linear->ops->solve = solve;
  linear->ops->free = [](SUNLinearSolver solver) {
    SUNLinSolFreeEmpty(solver);
    return SUNLS_SUCCESS;
  };
  void* const memory = kinsol.get();
  constexpr long never = std::numeric_limits<int>::max();
  // With valid arguments these fail only if memory is short.
  const auto check = [](int outcome) {
    if (outcome != KIN_SUCCESS) throw std::bad_alloc();
  };
  check(KINInit(memory, evaluate, scale.get()));
  check(KINSetUserData(memory, this));
  check(KINSetErrHandlerFn(memory, io::print_no_sundials_error, nullptr));
  check(KINSetLinearSolver(memory, linear.get(), matrix.get()));
  check(KINSetJacFn(memory, form_tangent));
  check(KINSetScaledStepTol(memory, rounding));
  // solve() reports old factors and limits the steps.
  check(KINSetNoInitSetup(memory, SUNTRUE));
  check(KINSetMaxSetupCalls(memory, never));
  check(KINSetMaxSubSetupCalls(memory, never));
  check(KINSetMaxNewtonStep(memory, std::numeric_limits<float>::max()));
  check(KINSetMaxBetaFails(memory, never));
}

/// KINSOL's system function. It asks for half the step if the residual is not finite or, a few times, if it has grown. KINSOL's
/// own line search would go to the minimum of the parabola through both ends. When a slender body turns far, the step stretches
/// it; the residual at the end of the step then has no relation to the path to it, and KINSOL's search takes twice the
/// iterations.
int ModifiedNewton::Solver::evaluate(N_Vector x, N_Vector residual, void* solver) {
  auto* const self = static_cast<Solver*>(solver);
  View f = view(residual);
  if (self->start != nullptr) {
    f = *std::exchange(self->start, nullptr);
  } else {
    self->equations->residual(view(x), f);
  }
  self->size = size_of(f);
  if (!std::isfinite(self->size)) {
    if (self->halvings_left > 0) --self->halvings_left;
    return too_far;
  }
  if (self->halvings_left == 0) return accepted;
  if (f.norm() < self->norm_before) {
    self->halvings_left = 0;
    return accepted;
  }
  --self->halvings_left;
  return too_far;
}

int ModifiedNewton::Solver::form_tangent(N_Vector x, N_Vector /*residual*/, SUNMatrix /*tangent*/, void* solver,
                                         N_Vector /*scratch1*/, N_Vector /*scratch2*/) {
  auto* const self = static_cast<Solver*>(solver);
  self->tangent = &self->equations->tangent(view(x));
  return 0;
}

int ModifiedNewton::Solver::factorise(SUNLinearSolver linear, SUNMatrix /*tangent*/) {
  auto* const self = static_cast<Solver*>(linear->content);
  ++self->factorisations;
  self->has_factors = self->is_new = self->factors.factorise(*self->tangent);
  return self->has_factors ? SUNLS_SUCCESS : SUNLS_LUFACT_FAIL;
}

/// Computes the step, shortened to the largest one. If it fails with old factors, KINSOL makes new ones and calls it again.
int ModifiedNewton::Solver::solve(SUNLinearSolver linear, SUNMatrix /*tangent*/, N_Vector step, N_Vector minus_residual,
                                  double /*tolerance*/) {
  auto* const self = static_cast<Solver*>(linear->content);
  const View right = view(minus_residual);
  const double size = size_of(right);
  const bool is_slow = size > fast * self->size_before;
  if (!self->has_factors || (!self->is_new && is_slow)) return SUNLS_CONV_FAIL;
  View p = view(step);
  p = self->factors.solve(right);
  const double length = size_of(p);
  if (!std::isfinite(length)) return self->is_new ? SUNLS_PACKAGE_FAIL_UNREC : SUNLS_CONV_FAIL;
  if (length > self->largest_step) p *= self->largest_step / length;
  self->was_old = !self->is_new;
  self->is_new = false;
  self->size_before = size;
  self->norm_before = right.norm();
  self->halvings_left = most_halvings;
  return SUNLS_SUCCESS;
}

double ModifiedNewton::Solver::search(const Equations& of, Eigen::VectorXd& x, const Eigen::VectorXd& residual, double tolerance,
                                      const NewtonOptions& options) {
  equations = &of;
  start = &residual;
  largest_step = options.largest_step;
  size_before = infinity;
  halvings_left = 0;
  const auto unknowns = io::sundials_made<io::SundialsVector>(N_VMake_Serial(x.size(), x.data(), context.get()));
  KINSetFuncNormTol(kinsol.get(), tolerance);
  long count = 0;
  const auto run = [&] {
    was_old = false;
    KINSetNumMaxIters(kinsol.get(), options.largest_iteration_count - count);
    const int end = KINSol(kinsol.get(), unknowns.get(), KIN_LINESEARCH, scale.get(), scale.get());
    long more = 0;
    KINGetNumNonlinSolvIters(kinsol.get(), &more);
    count += more;
    return end;
  };
  int outcome = run();
  const auto leads_nowhere = [&] { return outcome == KIN_REPTD_SYSFUNC_ERR || outcome == KIN_SYSFUNC_FAIL; };
  // KINSOL forms a new tangent if a step of old factors is too long, but stops if the residual has no value anywhere along the
  // step.
  while (leads_nowhere() && was_old && count < options.largest_iteration_count) {
    has_factors = false;
    outcome = run();
  }
  iterations += static_cast<std::size_t>(count);
  if (outcome != KIN_SUCCESS) {
    // A failed search has evaluated other points after the one where it ends.
    Eigen::VectorXd end(x.size());
    of.residual(x, end);
    size = size_of(end);
  }
  has_factors = has_factors && size <= fast * size_before;
  return outcome == KIN_LSETUP_FAIL ? infinity : size;
}

ModifiedNewton::ModifiedNewton() = default;
ModifiedNewton::~ModifiedNewton() = default;
ModifiedNewton::ModifiedNewton(ModifiedNewton&&) noexcept = default;
ModifiedNewton& ModifiedNewton::operator=(ModifiedNewton&&) noexcept = default;

bool ModifiedNewton::find_root(const Equations& equations, Eigen::VectorXd& x, const NewtonOptions& options) {
  Eigen::VectorXd residual(x.size());
  equations.residual(x, residual);
  const double start = size_of(residual);
  const double tolerance = std::clamp(1e-6 * start, rounding, std::max(rounding, options.tolerance));
  if (start <= tolerance) return true;
  const double good_enough = 1e3 * options.tolerance;
  if (!std::isfinite(start)) return false;
  if (options.largest_iteration_count <= 0) return start <= good_enough;
  if (!solver_) solver_ = std::make_unique<Solver>(x.size());
  return solver_->search(equations, x, residual, tolerance, options) <= std::max(tolerance, good_enough);
}

void ModifiedNewton::forget_tangent() {
  if (solver_) solver_->has_factors = false;
}

std::size_t ModifiedNewton::iteration_count() const { return solver_ ? solver_->iterations : 0; }

std::size_t ModifiedNewton::factorisation_count() const { return solver_ ? solver_->factorisations : 0; }

}  // namespace menger::voxel
