#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <functional>
#include <memory>

namespace menger::voxel {

/// A system of n equations F(x) = 0 in n unknowns. All its numbers are of order one.
struct Equations {
  using Values = Eigen::Ref<const Eigen::VectorXd>;

  /// Writes F(x), or numbers that are not finite where F has no value.
  std::function<void(const Values& x, Eigen::Ref<Eigen::VectorXd> residual)> residual;
  /// Returns dF/dx at x, n x n, with the same pattern in every call. The result stays valid until the next call. A call may
  /// change the values of F elsewhere, as coordinates with their origin at x do.
  std::function<const Eigen::SparseMatrix<double>&(const Values& x)> tangent;
};

/// Limits of a search for a root.
struct NewtonOptions {
  double tolerance = 1e-11;           ///< of the largest residual, or 1e-6 of its first value if that is less; not below 1e-13
  double largest_step = 0.5;          ///< of any unknown; beyond it a tangent is not accurate
  long largest_iteration_count = 20;  ///< 0: only evaluate the start
};

/// Modified Newton's method with a line search on the Euclidean norm of the residual. It uses KINSOL of SUNDIALS (@cite
/// hindmarsh2005sundials; its user guide, "Mathematical considerations"), with sparse LU factors behind its interfaces.
///
/// - The tangent and its factors are kept, also for the next search, as long as each step reduces the largest residual to less
/// than a fifth. The linear solver reports when the factors are too old, and KINSOL then forms new ones. KINSOL also does so when
/// a line search fails with old factors. If the residual has no value anywhere along a step of old factors, KINSOL ends its
/// search; it is then called again with a new tangent. KINSOL's own rules are not used: they count iterations, and would use each
/// tangent at least twice.
/// - No unknown changes by more than the largest step at once: the whole step is shortened. KINSOL's own bound
/// (KINSetMaxNewtonStep) is not used: it limits the Euclidean norm, which grows with the number of unknowns, it cannot be below
/// 1, and five such steps end a search.
/// - A step is halved, at most four times, if it raises the residual or if the residual has no value at its end. Only then
/// KINSOL's line search by parabolas takes over. It ends when half the square of the norm has fallen by 1e-4 of what the tangent
/// predicts. Its second condition prevents steps that are needlessly short. It concerns only steps shortened to below 1 / 1.8; a
/// step that violates it is accepted nevertheless.
///
/// Only one thread at a time may use an object. Different objects share nothing.
class ModifiedNewton {
 public:
  ModifiedNewton();
  ~ModifiedNewton();
  ModifiedNewton(ModifiedNewton&&) noexcept;
  ModifiedNewton& operator=(ModifiedNewton&&) noexcept;

  /// Searches for a root, starting at x, and leaves x where the search ends.
  /// @param equations with the same n and the same pattern of nonzeros in every call
  /// @return whether the largest residual at the end is small enough. It is if it is within the tolerance (see NewtonOptions).
  /// If further steps do not lower it, or iterations are used up, 1000 times options.tolerance is enough: near rounding that is
  /// all that can be reached. False if the residual has no value at the start or if a tangent was singular
  [[nodiscard]] bool find_root(const Equations& equations, Eigen::VectorXd& x, const NewtonOptions& options);

  /// Makes the next search begin with a new tangent.
  void forget_tangent();

  [[nodiscard]] std::size_t iteration_count() const;      ///< of all searches
  [[nodiscard]] std::size_t factorisation_count() const;  ///< of all searches

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;  ///< made by the first search, because KINSOL allocates its vectors at once
};

}  // namespace menger::voxel
