#include "fem/modes/vibration.h"

#include <slepceps.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace menger::fem {

namespace {

using EigensolverHandle = PetscHandle<EPS, EPSDestroy>;

/// Applies the factorisation of the body as an exact preconditioner.
PetscErrorCode apply_inverse(PC preconditioner, Vec right_hand_side, Vec solution) {
  void* context = nullptr;
  petsc(PCShellGetContext(preconditioner, &context));
  return static_cast<LinearisedBody*>(context)->solve(right_hand_side, solution) ? 0 : PETSC_ERR_NOT_CONVERGED;
}

/// Sets up shift-and-invert with the body's own factorisation: SLEPc neither computes K - shift M nor factorises it again.
void set_transformation(EPS solver, LinearisedBody& body) {
  ST transformation = nullptr;
  petsc(EPSGetST(solver, &transformation));
  petsc(STSetType(transformation, STSINVERT));
  petsc(STSetMatMode(transformation, ST_MATMODE_SHELL));
  petsc(STSetShift(transformation, body.shift()));
  KSP linear = nullptr;
  petsc(STGetKSP(transformation, &linear));
  petsc(KSPSetType(linear, KSPPREONLY));
  PC preconditioner = nullptr;
  petsc(KSPGetPC(linear, &preconditioner));
  petsc(PCSetType(preconditioner, PCSHELL));
  petsc(PCShellSetContext(preconditioner, &body));
  petsc(PCShellSetApply(preconditioner, apply_inverse));
}

/// Returns the number of unknowns that can move: neither held nor rigid motions.
PetscInt moving_count(const LinearisedBody& body, std::size_t rigid_modes) {
  const Space& space = body.assembly().space();
  const auto& held = body.assembly().held();
  long count = std::count(held.begin(), held.begin() + 3 * static_cast<std::ptrdiff_t>(space.owned_count), 0);
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_LONG, MPI_SUM, space.communicator);
  return static_cast<PetscInt>(count) - static_cast<PetscInt>(rigid_modes);
}

struct Mode {
  double eigenvalue;
  VectorHandle shape;
};

/// Returns the converged modes among the lowest ones that are orthogonal to the excluded vectors.
std::vector<Mode> search(LinearisedBody& body, const std::vector<Vec>& excluded, PetscInt count, double tolerance) {
  EigensolverHandle solver;
  petsc(EPSCreate(body.assembly().space().communicator, solver.receive()));
  petsc(EPSSetOperators(solver, body.stiffness(), body.mass()));
  petsc(EPSSetProblemType(solver, EPS_GHEP));
  petsc(EPSSetType(solver, EPSKRYLOVSCHUR));
  petsc(EPSSetWhichEigenpairs(solver, EPS_TARGET_MAGNITUDE));
  petsc(EPSSetTarget(solver, body.shift()));
  petsc(EPSSetDimensions(solver, count, PETSC_DEFAULT, PETSC_DEFAULT));
  petsc(EPSSetTolerances(solver, tolerance, PETSC_DEFAULT));
  set_transformation(solver, body);
  std::vector<Vec> vectors = excluded;
  if (!vectors.empty()) petsc(EPSSetDeflationSpace(solver, static_cast<PetscInt>(vectors.size()), vectors.data()));
  petsc(EPSSolve(solver));
  PetscInt converged = 0;
  petsc(EPSGetConverged(solver, &converged));
  std::vector<Mode> modes;
  for (PetscInt m = 0; m < std::min(converged, count); ++m) {
    Mode mode{0.0, body.make_vector()};
    petsc(EPSGetEigenpair(solver, m, &mode.eigenvalue, nullptr, mode.shape, nullptr));
    modes.push_back(std::move(mode));
  }
  return modes;
}

/// Returns the lowest modes that are not rigid, sorted.
///
/// A Krylov space contains only one vector of each eigenspace, except for rounding. Of the equal frequencies of a symmetric body
/// some may therefore be missing. Hence the modes found are excluded, and the search is repeated until it finds none that is
/// lower.
std::vector<Mode> lowest_modes(LinearisedBody& body, const std::vector<VectorHandle>& rigid, PetscInt wanted, double tolerance) {
  std::vector<Vec> excluded(rigid.begin(), rigid.end());
  const PetscInt available = moving_count(body, rigid.size());
  std::vector<Mode> found;
  const auto add = [&](std::vector<Mode> modes) {
    for (Mode& mode : modes) {
      excluded.push_back(mode.shape);
      found.push_back(std::move(mode));
    }
    std::sort(found.begin(), found.end(), [](const Mode& a, const Mode& b) { return a.eigenvalue < b.eigenvalue; });
  };
  add(search(body, excluded, wanted, tolerance));
  if (static_cast<PetscInt>(found.size()) < wanted) return found;
  while (static_cast<PetscInt>(found.size()) < available) {
    std::vector<Mode> next = search(body, excluded, 1, tolerance);
    const double highest = found[static_cast<std::size_t>(wanted) - 1].eigenvalue;
    if (next.empty() || next.front().eigenvalue >= highest) break;
    add(std::move(next));
  }
  found.resize(static_cast<std::size_t>(wanted));
  return found;
}

void turn_largest_positive(Vec mode) {
  double most = 0.0;
  double least = 0.0;
  petsc(VecMax(mode, nullptr, &most));
  petsc(VecMin(mode, nullptr, &least));
  // Rounding must not decide between ends of a symmetric mode that move alike.
  if (-least > (1.0 + 1e-6) * most) petsc(VecScale(mode, -1.0));
}

VibrationReport unstable(VibrationReport report, int count) {
  report.status = io::RunStatus::limit_point;
  report.reason = "the state is unstable under its pressures: the stiffness has " + std::to_string(count) +
                  " negative eigenvalue" + (count == 1 ? "" : "s");
  return report;
}

}  // namespace

VibrationReport vibrations(LinearisedBody& body, const VibrationOptions& options) {
  assert(options.mode_count > 0);
  VibrationReport report;
  if (!body.eigenvalues_below_shift()) {
    report.reason = "the stiffness of the state could not be factorised";
    return report;
  }
  if (*body.eigenvalues_below_shift() > 0) return unstable(std::move(report), *body.eigenvalues_below_shift());
  const std::vector<VectorHandle> rigid = body.free_rigid_motions();
  report.rigid_modes = static_cast<int>(rigid.size());
  const PetscInt wanted = std::min<PetscInt>(options.mode_count, moving_count(body, rigid.size()));
  const std::vector<Mode> modes = lowest_modes(body, rigid, wanted, options.relative_tolerance);

  const auto negative = std::count_if(modes.begin(), modes.end(), [](const Mode& mode) { return mode.eigenvalue <= 0.0; });
  if (negative > 0) return unstable(std::move(report), static_cast<int>(negative));
  if (static_cast<PetscInt>(modes.size()) < wanted) {
    report.reason = "the eigenvalue solver found " + std::to_string(modes.size()) + " of " + std::to_string(wanted) + " modes";
    return report;
  }
  for (const Mode& mode : modes) {
    turn_largest_positive(mode.shape);
    report.frequencies_Hz.push_back(0.5 * std::numbers::inv_pi * std::sqrt(mode.eigenvalue));
    report.modes.push_back(body.field_of(mode.shape));
  }
  report.status = io::RunStatus::completed;
  return report;
}

VibrationReport vibrations(Equilibrium& equilibrium, const BodyState& state, double dead_load_factor,
                           const VibrationOptions& options) {
  LinearisedBody body(equilibrium, state, dead_load_factor);
  return vibrations(body, options);
}

}  // namespace menger::fem
