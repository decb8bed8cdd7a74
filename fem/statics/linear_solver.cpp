#include "fem/statics/linear_solver.h"

namespace menger::fem {

namespace {

constexpr int gmres_restart = 100;
constexpr int largest_workspace_percent = 400;

bool uses_direct(const LinearOptions& options, const Space& space) {
  if (options.method != LinearMethod::automatic) return options.method == LinearMethod::direct;
  return 3 * static_cast<long>(space.node_count) <= options.largest_direct_size;
}

}  // namespace

LinearSolver::LinearSolver(const Assembly& assembly, const LinearOptions& options)
    : direct_(uses_direct(options, assembly.space())) {
  matrix_ = assembly.make_matrix(direct_);
  petsc(KSPCreate(assembly.space().communicator, solver_.receive()));
  petsc(KSPSetOperators(solver_, matrix_, matrix_));
  if (direct_) {
    set_up_direct();
  } else {
    set_up_iterative(assembly, options.relative_tolerance);
  }
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
  petsc(MatMumpsSetIcntl(factor, 7, 5));  // METIS ordering: smallest fill for hexahedra
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
    if (reason != PC_FACTOR_OUTMEMORY || !direct_) return reason == PC_NOERROR;
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
  if (reason > 0 || direct_) return reason > 0;
  // Conjugate gradients break down where the stiffness is indefinite, as it may be before an equilibrium is reached.
  petsc(KSPSetType(solver_, KSPGMRES));
  petsc(KSPGMRESSetRestart(solver_, gmres_restart));
  petsc(KSPSolve(solver_, b, x));
  petsc(KSPGetConvergedReason(solver_, &reason));
  petsc(KSPSetType(solver_, KSPCG));
  return reason > 0;
}

std::optional<int> LinearSolver::negative_pivots() const {
  if (!direct_) return std::nullopt;
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
