#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <functional>
#include <memory>

namespace menger::voxel {

/// n equations F(x) = 0 in n unknowns, of which all numbers are of order one.
struct Equations {
  using Values = Eigen::Ref<const Eigen::VectorXd>;

  /// Writes F(x), not finite where x has none.
  std::function<void(const Values& x, Eigen::Ref<Eigen::VectorXd> residual)> residual;
  /// dF/dx at x, n x n, of the same pattern in every call. It stays until the next call. A call may change what F is elsewhere,
  /// as coordinates do that have their origin at x.
  std::function<const Eigen::SparseMatrix<double>&(const Values& x)> tangent;
};

/// How far a search for a root goes.
struct NewtonOptions {
  double tolerance = 1e-11;           ///< of the largest residual, or 1e-6 of it at the start if that is less; not below 1e-13
  double largest_step = 0.5;          ///< of any unknown, beyond which a tangent says nothing
  long largest_iteration_count = 20;  ///< 0: only look at the start
};

/// Modified Newton's method with a line search on the Euclidean norm of the residual: KINSOL of SUNDIALS
/// (@cite hindmarsh2005sundials; its user guide, "Mathematical considerations"), with sparse LU factors behind its interfaces.
///
/// - Tangent and factors are kept, from one search to the next too, while a step brings the largest residual below a fifth. The
///   linear solver says when they are too old, and KINSOL forms new ones; so it does where a line search fails with old ones.
///   Where a step of old ones has no residual all along, which ends KINSOL's search, it is called again with a new tangent. Its
///   own rules count iterations, and would use each tangent twice at least.
/// - No unknown changes by more than the largest step at once: the whole step is cut. KINSOL's bound (KINSetMaxNewtonStep) is
///   one of the Euclidean norm, which grows with the number of unknowns; it cannot be below 1, and five such steps end a search.
/// - A step that raises the residual, or at whose end there is none, is halved four times at most, and only then left to KINSOL's
/// line search by parabolas,
///   which ends where half the square of the norm has fallen by 1e-4 of what the tangent promises. Its second condition, that
///   steps be not needlessly short, concerns those cut below 1 / 1.8; one that breaks it is taken all the same.
///
/// One thread at a time may use an object. Different objects share nothing.
class ModifiedNewton {
 public:
  ModifiedNewton();
  ~ModifiedNewton();
  ModifiedNewton(ModifiedNewton&&) noexcept;
  ModifiedNewton& operator=(ModifiedNewton&&) noexcept;

  /// Looks for a root from x on, and leaves x where it ends. @param equations of the same n and pattern in every call
  /// @return whether the largest residual there is within the tolerance or, where steps lower it no more or iterations end,
  /// within a thousand times options.tolerance, which near rounding is all there is; false where a tangent was singular
  [[nodiscard]] bool find_root(const Equations& equations, Eigen::VectorXd& x, const NewtonOptions& options);

  /// The next search begins with a new tangent.
  void forget_tangent();

  [[nodiscard]] std::size_t iteration_count() const;      ///< of all searches
  [[nodiscard]] std::size_t factorisation_count() const;  ///< of all searches

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;  ///< made by the first search: KINSOL allocates its vectors at once
};

}  // namespace menger::voxel
