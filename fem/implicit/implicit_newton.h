#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fem/space/petsc_handle.h"
#include "fem/statics/assembly.h"
#include "fem/statics/linear_solver.h"

namespace menger::fem {

/// An equation R(u) = 0 for the displacements of the nodes, 3 per local node, ghosts up to date.
struct NodalEquation {
  /// R, zero where held. @return whether there is one; the same on all ranks
  std::function<bool(std::span<const double> u, std::span<double> residual)> residual;
  std::function<void(std::span<const double> u, Mat matrix)> matrix;  ///< dR/du or something near it, the identity where held
  std::function<double(std::span<const double> u)> size;              ///< a norm, the same on all ranks
  /// Whether the residual at the last u that it was asked for is small where displacements say too little; the same on all ranks.
  std::function<bool(std::span<const double> residual)> is_balanced;
};

/// How Newton's method ended.
struct NewtonOutcome {
  enum class Kind { found, slow, no_answer, singular } kind = Kind::slow;
  int iterations = 0;
};

/// Newton's method by PETSc's SNES for the many equations of a motion, each near the last.
///
/// Full steps, unless the residual along a step shows that it went far beyond the least of a potential (two nodes that stick by
/// turns): then back to near there by false position. A factorisation is used again, also by the next equations, as long as the
/// steps shrink fast with it: a step costs a fraction of a factorisation. What is left after a step of size d is taken for d r /
/// (1 - r), r being the ratio of the last two; the first step is judged by the ratio of the last equation.
class ImplicitNewton {
 public:
  ImplicitNewton(const Assembly& assembly, const LinearOptions& options, NodalEquation equation);
  ImplicitNewton(const ImplicitNewton&) = delete;
  ImplicitNewton& operator=(const ImplicitNewton&) = delete;

  /// Improves u until what is left to the solution is at most a tolerance, in the size of the equation, and it is balanced.
  [[nodiscard]] NewtonOutcome solve(std::vector<double>& u, double tolerance);

  /// The next solve begins with a factorisation.
  void forget_factorisation() { is_stale_ = true; }

  /// x = K^-1 b with the factorisation at hand, if there is one. @return whether a solution was found
  bool apply_inverse(Vec b, Vec x) { return has_factor_ && linear_.solve(b, x); }

  [[nodiscard]] VectorHandle make_vector() const { return linear_.make_vector(); }
  [[nodiscard]] int factorisations() const { return linear_.factorisations(); }

 private:
  static PetscErrorCode compute_function(SNES snes, Vec x, Vec f, void* context);
  static PetscErrorCode compute_jacobian(SNES snes, Vec x, Mat matrix, Mat preconditioner, void* context);
  static PetscErrorCode apply_factor(PC preconditioner, Vec right_hand_side, Vec solution);
  static PetscErrorCode search_line(SNESLineSearch line_search, void* context);
  static PetscErrorCode test_convergence(SNES snes, PetscInt iteration, PetscReal, PetscReal, PetscReal,
                                         SNESConvergedReason* reason, void* context);
  void unpack(Vec x, std::vector<double>& u) const;
  void pack(std::span<const double> u, Vec x) const;
  void take_step(SNESLineSearch line_search);
  [[nodiscard]] bool wants_factorisation() const;
  [[nodiscard]] SNESConvergedReason judge(PetscInt iteration);

  const Assembly& assembly_;
  NodalEquation equation_;
  LinearSolver linear_;
  NonlinearSolverHandle snes_;
  VectorHandle unknown_;
  VectorHandle residual_vector_;
  std::vector<double> u_;
  std::vector<double> residual_;
  std::vector<double> change_;
  bool has_factor_ = false;
  bool is_stale_ = true;
  bool singular_ = false;
  bool has_answer_ = false;
  double tolerance_ = 0.0;
  double rate_ = 0.5;       ///< of the last equation
  double this_rate_ = 0.0;  ///< of this one; 0: not known yet
  double step_size_ = 0.0;
  int steps_with_factor_ = 0;  ///< in this equation
};

}  // namespace menger::fem
