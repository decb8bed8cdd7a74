#include <algorithm>

#include "fem/statics/equilibrium_search.h"

namespace menger::fem {

namespace {

PetscErrorCode product_that_is_not_needed(Mat, Vec, Vec product) { return VecZeroEntries(product); }

}  // namespace

void Equilibrium::Search::create_solver() {
  const auto plena = static_cast<PetscInt>(body.plenum_count);
  const PetscInt here = 3 * space.owned_count + (rank_ == 0 ? plena : 0);
  petsc(VecCreateMPI(space.communicator, here, PETSC_DETERMINE, unknown_.receive()));
  petsc(VecDuplicate(unknown_, residual_vector_.receive()));
  displacement_part_ = linear_.make_vector();
  particular_ = linear_.make_vector();
  for (std::size_t p = 0; p < body.plenum_count; ++p) influences_.push_back(linear_.make_vector());

  petsc(MatCreateShell(space.communicator, here, here, PETSC_DETERMINE, PETSC_DETERMINE, this, shell_.receive()));
  // SNES multiplies with it only to tell why a line search has failed, which we know
  for (const MatOperation operation : {MATOP_MULT, MATOP_MULT_TRANSPOSE})
    petsc(MatShellSetOperation(shell_, operation, reinterpret_cast<void (*)()>(product_that_is_not_needed)));
  petsc(SNESCreate(space.communicator, snes_.receive()));
  petsc(SNESSetType(snes_, SNESNEWTONLS));
  petsc(SNESSetFunction(snes_, residual_vector_, compute_function, this));
  petsc(SNESSetJacobian(snes_, shell_, shell_, compute_jacobian, this));
  petsc(SNESSetConvergenceTest(snes_, test_convergence, this, nullptr));
  petsc(SNESSetTolerances(snes_, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, options_.largest_iteration_count, 1'000'000));
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

void Equilibrium::Search::unpack(Vec x, std::vector<double>& displacements, std::vector<double>& pressures) const {
  const double* data = nullptr;
  petsc(VecGetArrayRead(x, &data));
  displacements.resize(3 * space.positions.size());
  std::copy(data, data + owned_components(), displacements.begin());
  pressures.resize(body.plenum_count);
  if (rank_ == 0) std::copy(data + owned_components(), data + owned_components() + body.plenum_count, pressures.begin());
  petsc(VecRestoreArrayRead(x, &data));
  assembly.exchange().update_ghosts(displacements);
  MPI_Bcast(pressures.data(), static_cast<int>(pressures.size()), MPI_DOUBLE, 0, space.communicator);
}

void Equilibrium::Search::pack(const BodyState& state, Vec x) const {
  double* data = nullptr;
  petsc(VecGetArrayWrite(x, &data));
  for (std::size_t n = 0; n < owned_components(); ++n) data[n] = assembly.held()[n] != 0 ? 0.0 : state.displacements_m[n];
  for (const PlateComponent& component : plate_components_) data[component.place] = state.displacements_m[component.place];
  if (rank_ == 0) std::copy(state.plenum_pressures_Pa.begin(), state.plenum_pressures_Pa.end(), data + owned_components());
  petsc(VecRestoreArrayWrite(x, &data));
}

PetscErrorCode Equilibrium::Search::compute_function(SNES, Vec x, Vec f, void* context) {
  static_cast<Search*>(context)->function(x, f);
  return 0;
}

PetscErrorCode Equilibrium::Search::compute_jacobian(SNES, Vec x, Mat, Mat, void* context) {
  static_cast<Search*>(context)->jacobian(x);
  return 0;
}

PetscErrorCode Equilibrium::Search::apply_inverse(PC preconditioner, Vec right_hand_side, Vec solution) {
  void* context = nullptr;
  petsc(PCShellGetContext(preconditioner, &context));
  static_cast<Search*>(context)->solve_linear(right_hand_side, solution);
  return 0;
}

PetscErrorCode Equilibrium::Search::search_line(SNESLineSearch line_search, void* context) {
  static_cast<Search*>(context)->step(line_search);
  return 0;
}

PetscErrorCode Equilibrium::Search::test_convergence(SNES, PetscInt, PetscReal, PetscReal, PetscReal, SNESConvergedReason* reason,
                                                     void* context) {
  *reason = static_cast<Search*>(context)->convergence();
  return 0;
}

}  // namespace menger::fem
