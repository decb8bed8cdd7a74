#pragma once

#include <optional>

#include "fem/space/petsc_handle.h"
#include "fem/statics/assembly.h"

namespace menger::fem {

/// The method that solves linear systems with the stiffness.
enum class LinearMethod {
  automatic,  ///< direct up to largest_direct_size unknowns, iterative above
  direct,     ///< MUMPS, LDL^T of the symmetric matrix, which may be indefinite
  /// Conjugate gradients, preconditioned by algebraic multigrid (GAMG) with the rigid-body modes as near-null space; GMRES where
  /// the matrix turns out indefinite.
  iterative
};

struct LinearOptions {
  LinearMethod method = LinearMethod::automatic;
  int largest_direct_size = 150'000;  ///< unknowns
  double relative_tolerance = 1e-7;   ///< for the iterative method
};

/// The stiffness matrix of a body and a solver for it.
class LinearSolver {
 public:
  LinearSolver(const Assembly& assembly, const LinearOptions& options);

  /// Returns the matrix to assemble into.
  [[nodiscard]] Mat matrix() const { return matrix_; }

  /// Prepares solutions with the present values of the matrix: computes a factorisation or a new preconditioner.
  /// @return whether it succeeded; it does not with a singular matrix
  bool prepare();

  /// Solves x = K^-1 b with the values of the last preparation. @return whether a solution was found
  bool solve(Vec b, Vec x);

  /// Returns the number of negative pivots of the factorisation, which is the number of negative eigenvalues of the stiffness.
  /// Nothing with the iterative method.
  [[nodiscard]] std::optional<int> negative_pivots() const;

  /// Creates a vector of the unknowns: the owned components of this rank.
  [[nodiscard]] VectorHandle make_vector() const;

 private:
  void set_up_direct();
  void set_up_iterative(const Assembly& assembly, double tolerance);

  MatrixHandle matrix_;
  LinearSolverHandle solver_;
  bool direct_;
  int workspace_percent_ = 20;  ///< extra workspace of MUMPS beyond its estimate
};

}  // namespace menger::fem
