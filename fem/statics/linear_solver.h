#pragma once

#include <optional>
#include <string>

#include "fem/space/petsc_handle.h"
#include "fem/statics/assembly.h"

namespace menger::fem {

/// The method that solves linear systems with the stiffness.
enum class LinearMethod {
  automatic,  ///< the cheaper one by an estimate, see choose_linear_method
  direct,     ///< MUMPS, LDL^T of the symmetric matrix, which may be indefinite
  /// Conjugate gradients, preconditioned by algebraic multigrid (GAMG) with the rigid-body modes as near-null space; GMRES where
  /// the matrix turns out indefinite.
  iterative
};

struct LinearOptions {
  LinearMethod method = LinearMethod::automatic;
  int largest_direct_size = 150'000;  ///< unknowns up to which automatic means direct, without an estimate
  double relative_tolerance = 1e-7;   ///< for the iterative method
};

/// What a factorisation of the stiffness takes, as MUMPS estimates it from the pattern of the matrix.
struct FactorEstimate {
  double operations = 0.0;
  double bytes = 0.0;  ///< on all ranks together
};

/// The method that a solver uses, and why. Never `automatic`.
struct LinearChoice {
  LinearMethod method = LinearMethod::direct;
  std::string reason{};

  /// "direct: ..."
  [[nodiscard]] std::string text() const;
};

/// Analyses the pattern of a stiffness in the storage of the direct method (see Assembly::make_matrix). The values do not matter,
/// and it costs little beside one factorisation.
FactorEstimate estimate_factor(Mat matrix);

/// Chooses the cheaper method for a stiffness. The choice depends on the body and on the memory that the machine has, never on
/// its load: the same body gets the same method on the same machine.
///
/// Direct, unless the factors take more than half of the memory, or a factorisation takes more than three million operations
/// for each unknown. Thin walls need a tenth of that, thick blocks the more the larger they are. Conjugate gradients need about a
/// hundred thousand where they converge fast, and many times that in thin walls; but their operations wait for memory, and take
/// some 24 times as long as those of a factorisation.
LinearChoice choose_linear_method(long unknowns, const FactorEstimate& estimate, double machine_bytes);

/// The stiffness matrix of a body and a solver for it.
class LinearSolver {
 public:
  LinearSolver(const Assembly& assembly, const LinearOptions& options);

  /// Returns the method that it uses, and why.
  [[nodiscard]] const LinearChoice& choice() const { return choice_; }

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
  [[nodiscard]] bool is_direct() const { return choice_.method == LinearMethod::direct; }
  void choose(const Assembly& assembly, const LinearOptions& options);
  void set_up_direct();
  void set_up_iterative(const Assembly& assembly, double tolerance);

  MatrixHandle matrix_;
  LinearSolverHandle solver_;
  LinearChoice choice_;
  int workspace_percent_ = 20;  ///< extra workspace of MUMPS beyond its estimate
};

}  // namespace menger::fem
