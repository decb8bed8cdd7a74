#include "fem/statics/linear_solver.h"

#include "io/process/machine_memory.h"
#include "io/text/formatted.h"

namespace menger::fem {

namespace {

constexpr int gmres_restart = 100;
constexpr int largest_workspace_percent = 400;
/// METIS, which gives the smallest fill for hexahedra. A MUMPS without it, such as Debian's, takes its own PORD instead.
constexpr int ordering = 5;

constexpr double largest_memory_share = 0.5;

/// Measured on a thick cube of 52,536 unknowns, where conjugate gradients are at their best: 38 iterations for each solution, 8e4
/// operations for each unknown and stiffness, 1.0e9 of them a second. A factorisation does 24e9 a second, so that both take
/// equally long at 2e6. A body of thin walls with 33,858 unknowns needs 1.3e5 for a factorisation, and ten times as long for the
/// iterations.
constexpr double largest_operations_per_unknown = 3e6;
constexpr double gigabyte = 1e9;

}  // namespace

FactorEstimate estimate_factor(Mat matrix) {
  MatrixHandle factor;
  petsc(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor.receive()));
  petsc(MatMumpsSetIcntl(factor, 6, 0));  // no permutation by values, of which there are none yet
  petsc(MatMumpsSetIcntl(factor, 7, ordering));
  MatFactorInfo info;
  petsc(MatFactorInfoInitialize(&info));
  petsc(MatCholeskyFactorSymbolic(factor, matrix, nullptr, &info));
  PetscReal operations = 0.0;
  petsc(MatMumpsGetRinfog(factor, 1, &operations));
  PetscInt megabytes = 0;
  petsc(MatMumpsGetInfog(factor, 17, &megabytes));
  return {operations, 1e6 * static_cast<double>(megabytes)};
}

std::string LinearChoice::text() const { return (method == LinearMethod::direct ? "direct: " : "iterative: ") + reason; }

LinearChoice choose_linear_method(long unknowns, const FactorEstimate& estimate, double machine_bytes) {
  const std::string takes = "a factorisation takes about " + io::shown(estimate.bytes / gigabyte, 2) + " GB and " +
                            io::shown(estimate.operations, 2) + " operations";
  if (estimate.bytes > largest_memory_share * machine_bytes)
    return {LinearMethod::iterative,
            takes + ", more than half of the " + io::shown(machine_bytes / gigabyte, 2) + " GB of this machine's memory"};
  if (estimate.operations > largest_operations_per_unknown * static_cast<double>(unknowns))
    return {LinearMethod::iterative, takes + ", more than " + io::shown(largest_operations_per_unknown) + " for each unknown"};
  return {LinearMethod::direct, takes};
}

LinearSolver::LinearSolver(const Assembly& assembly, const LinearOptions& options) {
  choose(assembly, options);
  petsc(KSPCreate(assembly.space().communicator, solver_.receive()));
  petsc(KSPSetOperators(solver_, matrix_, matrix_));
  if (is_direct()) {
    set_up_direct();
  } else {
    set_up_iterative(assembly, options.relative_tolerance);
  }
}

void LinearSolver::choose(const Assembly& assembly, const LinearOptions& options) {
  const long unknowns = 3 * static_cast<long>(assembly.space().node_count);
  if (options.method != LinearMethod::automatic) {
    choice_ = {options.method, "as the study says"};
  } else if (unknowns <= options.largest_direct_size) {
    choice_ = {LinearMethod::direct, std::to_string(unknowns) + " unknowns"};
  } else {
    matrix_ = assembly.make_matrix(true);
    double machine_bytes = io::machine_memory_bytes();
    MPI_Allreduce(MPI_IN_PLACE, &machine_bytes, 1, MPI_DOUBLE, MPI_MIN, assembly.space().communicator);
    choice_ = choose_linear_method(unknowns, estimate_factor(matrix_), machine_bytes);
    if (is_direct()) return;
  }
  matrix_ = assembly.make_matrix(is_direct());
}

void LinearSolver::set_up_direct() {
  petsc(KSPSetType(solver_, KSPPREONLY));
  PC preconditioner = nullptr;
  petsc(KSPGetPC(solver_, &preconditioner));
  petsc(PCSetType(preconditioner, PCCHOLESKY));
  petsc(PCFactorSetMatSolverType(preconditioner, MATSOLVERMUMPS));
  petsc(PCFactorSetUpMatSolverType(preconditioner));
  Mat factor = nullptr;
  petsc(PCFactorGetMatrix(preconditioner, &factor));
  petsc(MatMumpsSetIcntl(factor, 7, ordering));
  petsc(MatMumpsSetIcntl(factor, 14, workspace_percent_));
}

void LinearSolver::set_up_iterative(const Assembly& assembly, double tolerance) {
  petsc(KSPSetType(solver_, KSPCG));
  petsc(KSPSetTolerances(solver_, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, 600));
  PC preconditioner = nullptr;
  petsc(KSPGetPC(solver_, &preconditioner));
  petsc(PCSetType(preconditioner, PCGAMG));

  const Space& space = assembly.space();
  VectorHandle coordinates;
  petsc(VecCreateMPI(space.communicator, 3 * space.owned_count, PETSC_DETERMINE, coordinates.receive()));
  petsc(VecSetBlockSize(coordinates, 3));
  double* data = nullptr;
  petsc(VecGetArrayWrite(coordinates, &data));
  for (Index node = 0; node < space.owned_count; ++node)
    for (std::size_t i = 0; i < 3; ++i)
      data[3 * static_cast<std::size_t>(node) + i] = space.positions[static_cast<std::size_t>(node)][i];
  petsc(VecRestoreArrayWrite(coordinates, &data));
  NullSpaceHandle rigid_body_modes;
  petsc(MatNullSpaceCreateRigidBody(coordinates, rigid_body_modes.receive()));
  petsc(MatSetNearNullSpace(matrix_, rigid_body_modes));
}

bool LinearSolver::prepare() {
  for (; workspace_percent_ <= largest_workspace_percent; workspace_percent_ *= 2) {
    petsc(KSPSetOperators(solver_, matrix_, matrix_));
    petsc(KSPSetUp(solver_));
    PC preconditioner = nullptr;
    petsc(KSPGetPC(solver_, &preconditioner));
    PCFailedReason reason = PC_NOERROR;
    petsc(PCGetFailedReason(preconditioner, &reason));
    // Delayed pivots of an indefinite matrix need more workspace than the estimate.
    if (reason != PC_FACTOR_OUTMEMORY || !is_direct()) return reason == PC_NOERROR;
    Mat factor = nullptr;
    petsc(PCFactorGetMatrix(preconditioner, &factor));
    petsc(MatMumpsSetIcntl(factor, 14, 2 * workspace_percent_));
    petsc(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));  // marks the matrix as changed, so that it is factorised again
    petsc(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  }
  workspace_percent_ = largest_workspace_percent;
  return false;
}

bool LinearSolver::solve(Vec b, Vec x) {
  petsc(KSPSolve(solver_, b, x));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  petsc(KSPGetConvergedReason(solver_, &reason));
  if (reason > 0 || is_direct()) return reason > 0;
  // Conjugate gradients break down where the stiffness is indefinite, as it may be before an equilibrium is reached.
  petsc(KSPSetType(solver_, KSPGMRES));
  petsc(KSPGMRESSetRestart(solver_, gmres_restart));
  petsc(KSPSolve(solver_, b, x));
  petsc(KSPGetConvergedReason(solver_, &reason));
  petsc(KSPSetType(solver_, KSPCG));
  return reason > 0;
}

std::optional<int> LinearSolver::negative_pivots() const {
  if (!is_direct()) return std::nullopt;
  PC preconditioner = nullptr;
  petsc(KSPGetPC(solver_, &preconditioner));
  Mat factor = nullptr;
  petsc(PCFactorGetMatrix(preconditioner, &factor));
  PetscInt count = 0;
  petsc(MatMumpsGetInfog(factor, 12, &count));
  return static_cast<int>(count);
}

VectorHandle LinearSolver::make_vector() const {
  VectorHandle vector;
  petsc(MatCreateVecs(matrix_, vector.receive(), nullptr));
  return vector;
}

}  // namespace menger::fem
