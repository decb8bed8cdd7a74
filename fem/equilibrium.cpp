#include "fem/equilibrium.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "fem/dead_load.h"
#include "fem/petsc_handle.h"
#include "fem/supports.h"

namespace menger::fem {

namespace {

/// A factorisation is used again if the residual fell at least by the first factor with it when it was new, and after that as
/// long as it falls by the second: the cost of a few solves against that of a factorisation.
constexpr double fast_reduction = 0.02;
constexpr double lasting_reduction = 0.2;

/// Newton's steps shrink, or the residual does; one step that grew with it may find its way back, more of them do not.
constexpr int most_growing_steps = 2;

/// Part of (shear modulus x length^2) that counts as load even without any, so that the state at rest is an equilibrium.
constexpr double smallest_reference_load = 1e-4;

double diameter_of(const Space& space) {
  std::array<double, 3> least{1e300, 1e300, 1e300};
  std::array<double, 3> most{-1e300, -1e300, -1e300};
  for (const Point& x : space.positions) {
    for (std::size_t i = 0; i < 3; ++i) {
      least[i] = std::min(least[i], x[i]);
      most[i] = std::max(most[i], x[i]);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, least.data(), 3, MPI_DOUBLE, MPI_MIN, space.communicator);
  MPI_Allreduce(MPI_IN_PLACE, most.data(), 3, MPI_DOUBLE, MPI_MAX, space.communicator);
  return norm(difference(most, least));
}

PetscErrorCode product_that_is_not_needed(Mat, Vec, Vec product) { return VecZeroEntries(product); }

}  // namespace

/// One problem and its solvers. Vectors of SNES hold the owned displacement components and, on the first rank, the pressures of
/// all plena; those that are given have the residual zero and do not change.
class Equilibrium::Search {
 public:
  Search(const Space& space, const Body& body, const EquilibriumOptions& options);

  EquilibriumReport solve(BodyState& state, std::span<const PlenumControl> controls, double dead_load_factor,
                          std::span<const double> first_pressures, const std::atomic<bool>* stop);

  const Space& space;
  const Body& body;
  Assembly assembly;

  void assemble_stiffness(std::span<const double> displacements, std::span<const double> pressures);
  [[nodiscard]] std::optional<int> count_negative_pivots(const BodyState& state);
  [[nodiscard]] std::vector<double> plenum_volumes(const BodyTotals& totals) const;
  void move_plates(std::span<const PlateMotion> motions);
  double dead_load_factor = 1.0;

 private:
  // Callbacks of PETSc, with the search as context.
  static PetscErrorCode compute_function(SNES snes, Vec x, Vec f, void* context);
  static PetscErrorCode compute_jacobian(SNES snes, Vec x, Mat jacobian, Mat preconditioner, void* context);
  static PetscErrorCode apply_inverse(PC preconditioner, Vec right_hand_side, Vec solution);
  static PetscErrorCode search_line(SNESLineSearch line_search, void* context);
  static PetscErrorCode test_convergence(SNES snes, PetscInt iteration, PetscReal, PetscReal, PetscReal,
                                         SNESConvergedReason* reason, void* context);

  /// A component that a plate holds: its place among the owned ones, and where it is to be.
  struct PlateComponent {
    std::size_t place;
    double imposed_m;
  };

  void create_solver();
  [[nodiscard]] Loads loads(std::span<const double> pressures) const { return {pressures, dead_load_factor, motions_}; }
  void carry_along(Vec trial, Vec from, double length) const;
  void unpack(Vec x, std::vector<double>& displacements, std::vector<double>& pressures) const;
  void pack(const BodyState& state, Vec x) const;
  void function(Vec x, Vec f);
  void jacobian(Vec x);
  void solve_linear(Vec right_hand_side, Vec solution);
  void step(SNESLineSearch line_search);
  [[nodiscard]] SNESConvergedReason convergence() const;
  [[nodiscard]] bool is_free(std::size_t plenum) const { return !std::holds_alternative<PressureControl>(controls_[plenum]); }
  [[nodiscard]] std::size_t owned_components() const { return 3 * static_cast<std::size_t>(space.owned_count); }
  [[nodiscard]] double norm_of_owned(std::span<const double> field) const;
  [[nodiscard]] std::string failure_reason(int iterations) const;
  [[nodiscard]] EquilibriumReport report_of(SNESConvergedReason reason);

  EquilibriumOptions options_;
  LinearSolver linear_;
  NonlinearSolverHandle snes_;
  MatrixHandle shell_;
  VectorHandle unknown_;
  VectorHandle residual_vector_;
  VectorHandle displacement_part_;
  VectorHandle particular_;
  std::vector<VectorHandle> influences_;  ///< K^-1 dV/du of each plenum that is free
  std::vector<PlateMotion> motions_;
  std::vector<PlateComponent> plate_components_;
  int rank_ = 0;
  bool is_held_;  ///< MUMPS does not notice a singular stiffness
  double diameter_m_ = 0.0;
  double floor_N_ = 0.0;
  double dead_load_norm_N_ = 0.0;

  // Of the running search.
  std::span<const PlenumControl> controls_;
  std::span<const double> first_pressures_;
  const std::atomic<bool>* stop_ = nullptr;
  std::vector<double> displacements_;
  std::vector<double> pressures_;
  std::vector<double> residual_;
  std::vector<std::vector<double>> volume_gradients_;
  std::vector<std::vector<double>> gradients_of_factor_;  ///< of the state whose stiffness is factorised
  std::vector<PlenumClosure> closures_;
  double plate_distance_m_ = 0.0;           ///< largest distance of a held component from where its plate carries it
  std::vector<double> plate_step_m_;        ///< per local component, minus what is left of the way
  std::vector<double> plate_step_force_N_;  ///< K times it
  BodyTotals totals_;
  PetscInt iterations_ = 0;
  bool has_answer_ = false;
  bool singular_ = false;
  bool cut_to_nothing_ = false;
  bool is_first_ = true;
  bool uses_factor_again_ = false;
  double residual_N_ = 0.0;
  double previous_residual_N_ = 0.0;
  double reference_N_ = 0.0;
  double residual_before_N_ = 0.0;
  double largest_step_m_ = 0.0;
  int growing_steps_ = 0;
  bool runs_away_ = false;
};

Equilibrium::Search::Search(const Space& the_space, const Body& the_body, const EquilibriumOptions& options)
    : space(the_space),
      body(the_body),
      assembly(the_space, the_body),
      options_(options),
      linear_(assembly, options.linear),
      is_held_(fem::is_held(the_space, the_body, assembly.held())),
      diameter_m_(diameter_of(the_space)) {
  MPI_Comm_rank(space.communicator, &rank_);
  // The softest region: a load that strains it must not pass for none beside a stiff one.
  double modulus_Pa = std::numeric_limits<double>::infinity();
  for (const RegionMaterial& region : body.regions)
    modulus_Pa = std::min(modulus_Pa, materials::shear_modulus_at_rest_Pa(region.law));
  floor_N_ = smallest_reference_load * modulus_Pa * diameter_m_ * diameter_m_;
  std::vector<double> dead_load = dead_load_of(space, body);
  assembly.exchange().add_from_ghosts(dead_load);
  dead_load_norm_N_ = norm_of_owned(dead_load);
  move_plates(std::vector<PlateMotion>(body.plates.size()));
  create_solver();
}

void Equilibrium::Search::move_plates(std::span<const PlateMotion> motions) {
  assert(motions.size() == body.plates.size());
  motions_.assign(motions.begin(), motions.end());
  plate_components_.clear();
  for (std::size_t p = 0; p < body.plates.size(); ++p) {
    for (const Index node : assembly.plate_nodes(p)) {
      const auto local = static_cast<std::size_t>(node);
      const Point displacement = plate_displacement(body.plates[p], motions_[p], space.positions[local]);
      for (std::size_t i = 0; i < 3; ++i)
        if (body.plates[p].held[i]) plate_components_.push_back({3 * local + i, displacement[i]});
    }
  }
}

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

double Equilibrium::Search::norm_of_owned(std::span<const double> field) const {
  double square = 0.0;
  for (std::size_t n = 0; n < owned_components(); ++n) square += field[n] * field[n];
  MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, space.communicator);
  return std::sqrt(square);
}

std::vector<double> Equilibrium::Search::plenum_volumes(const BodyTotals& totals) const {
  std::vector<double> volumes(body.plenum_count, 0.0);
  for (std::size_t c = 0; c < body.chambers.size(); ++c) volumes[body.chambers[c].plenum] += totals.chamber_volumes_m3[c];
  return volumes;
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

void Equilibrium::Search::assemble_stiffness(std::span<const double> displacements, std::span<const double> pressures) {
  if (plate_distance_m_ == 0.0) {
    assembly.assemble(displacements, loads(pressures), {}, {}, linear_.matrix());
    return;
  }
  plate_step_m_.assign(displacements.size(), 0.0);
  plate_step_force_N_.assign(displacements.size(), 0.0);
  for (const auto& [place, imposed_m] : plate_components_) plate_step_m_[place] = displacements[place] - imposed_m;
  assembly.exchange().update_ghosts(plate_step_m_);
  const HeldChange step{plate_step_m_, plate_step_force_N_};
  assembly.assemble(displacements, loads(pressures), {}, {}, linear_.matrix(), &step);
}

std::optional<int> Equilibrium::Search::count_negative_pivots(const BodyState& state) {
  assembly.elements().forget_prediction();
  plate_distance_m_ = 0.0;
  assemble_stiffness(state.displacements_m, state.plenum_pressures_Pa);
  return linear_.prepare() ? linear_.negative_pivots() : std::nullopt;
}

void Equilibrium::Search::function(Vec x, Vec f) {
  unpack(x, displacements_, pressures_);
  residual_.resize(displacements_.size());
  volume_gradients_.resize(body.plenum_count);
  totals_ = assembly.assemble(displacements_, loads(pressures_), residual_, volume_gradients_, nullptr);
  has_answer_ = totals_.smallest_ratio > 0.0 && std::isfinite(totals_.strain_energy_J);

  const std::vector<double> volumes = plenum_volumes(totals_);
  closures_.assign(body.plenum_count, {0.0, 1.0, 0.0});
  std::vector<double> pressure_force(residual_.size(), 0.0);
  for (std::size_t p = 0; p < body.plenum_count; ++p) {
    for (std::size_t n = 0; n < pressure_force.size(); ++n) pressure_force[n] += pressures_[p] * volume_gradients_[p][n];
    if (!is_free(p)) continue;
    const auto closure = plenum_closure(controls_[p], pressures_[p], volumes[p]);
    if (closure) {
      closures_[p] = *closure;
    } else {
      has_answer_ = false;
    }
  }
  residual_N_ = norm_of_owned(residual_);
  reference_N_ =
      std::max(floor_N_, norm_of_owned(pressure_force) + dead_load_factor * dead_load_norm_N_ + totals_.plate_force_norm_N);
  plate_distance_m_ = 0.0;
  for (const auto& [place, imposed_m] : plate_components_)
    plate_distance_m_ = std::max(plate_distance_m_, std::abs(displacements_[place] - imposed_m));
  MPI_Allreduce(MPI_IN_PLACE, &plate_distance_m_, 1, MPI_DOUBLE, MPI_MAX, space.communicator);
  if (!std::isfinite(residual_N_)) has_answer_ = false;

  double* data = nullptr;
  petsc(VecGetArrayWrite(f, &data));
  // PETSc gives up at the first number that is none; a state without an answer is dealt with in the line search
  for (std::size_t n = 0; n < owned_components(); ++n) data[n] = has_answer_ ? residual_[n] : 0.0;
  for (const auto& [place, imposed_m] : plate_components_) data[place] = has_answer_ ? displacements_[place] - imposed_m : 0.0;
  if (rank_ == 0) {
    for (std::size_t p = 0; p < body.plenum_count; ++p) data[owned_components() + p] = closures_[p].residual;
  }
  petsc(VecRestoreArrayWrite(f, &data));
}

void Equilibrium::Search::jacobian(Vec x) {
  const double reduction = uses_factor_again_ ? lasting_reduction : fast_reduction;
  uses_factor_again_ = !is_first_ && plate_distance_m_ == 0.0 && residual_N_ < reduction * previous_residual_N_;
  previous_residual_N_ = residual_N_;
  if (uses_factor_again_) return;
  unpack(x, displacements_, pressures_);
  const bool uses_first = is_first_ && !first_pressures_.empty();
  const std::span<const double> pressures = uses_first ? first_pressures_ : std::span<const double>(pressures_);
  is_first_ = false;
  assemble_stiffness(displacements_, pressures);
  gradients_of_factor_ = volume_gradients_;
  if (!linear_.prepare()) {
    singular_ = true;
    return;
  }
  for (std::size_t p = 0; p < body.plenum_count; ++p) {
    if (!is_free(p)) continue;
    double* data = nullptr;
    petsc(VecGetArrayWrite(displacement_part_, &data));
    std::copy_n(volume_gradients_[p].begin(), owned_components(), data);
    petsc(VecRestoreArrayWrite(displacement_part_, &data));
    if (!linear_.solve(displacement_part_, influences_[p])) singular_ = true;
  }
}

/// Puts the plates into a trial state exactly where a step of some length carries them: its arithmetic would leave rounding.
void Equilibrium::Search::carry_along(Vec trial, Vec from, double length) const {
  const double* before = nullptr;
  double* data = nullptr;
  petsc(VecGetArrayRead(from, &before));
  petsc(VecGetArray(trial, &data));
  for (const auto& [place, imposed_m] : plate_components_) data[place] = (1.0 - length) * before[place] + length * imposed_m;
  petsc(VecRestoreArray(trial, &data));
  petsc(VecRestoreArrayRead(from, &before));
}

/// Solves K y - sum_p V_p y_p = r, V_p . y + c_p y_p = c for every free plenum p, V_p being dV_p/du. On a plate y = r, and K y
/// there goes to the right-hand side; V_p leaves it out, which only the first step of a plate notices.
void Equilibrium::Search::solve_linear(Vec right_hand_side, Vec solution) {
  petsc(VecZeroEntries(solution));
  if (singular_) return;
  const double* r = nullptr;
  double* data = nullptr;
  petsc(VecGetArrayRead(right_hand_side, &r));
  petsc(VecGetArrayWrite(displacement_part_, &data));
  std::copy_n(r, owned_components(), data);
  if (plate_distance_m_ > 0.0)
    for (std::size_t n = 0; n < owned_components(); ++n) data[n] -= plate_step_force_N_[n];
  petsc(VecRestoreArrayWrite(displacement_part_, &data));
  petsc(VecRestoreArrayRead(right_hand_side, &r));
  if (!linear_.solve(displacement_part_, particular_)) {
    singular_ = true;
    return;
  }

  std::vector<std::size_t> free;
  for (std::size_t p = 0; p < body.plenum_count; ++p)
    if (is_free(p)) free.push_back(p);
  const auto count = static_cast<Eigen::Index>(free.size());
  const auto times_gradient = [&](std::size_t plenum, Vec vector) {
    const double* values = nullptr;
    petsc(VecGetArrayRead(vector, &values));
    double sum = 0.0;
    for (std::size_t n = 0; n < owned_components(); ++n) sum += gradients_of_factor_[plenum][n] * values[n];
    petsc(VecRestoreArrayRead(vector, &values));
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, space.communicator);
    return sum;
  };
  Eigen::MatrixXd schur(count, count);
  Eigen::VectorXd right(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t p = free[static_cast<std::size_t>(i)];
    right[i] = closures_[p].residual - times_gradient(p, particular_);
    for (Eigen::Index j = 0; j < count; ++j) schur(i, j) = times_gradient(p, influences_[free[static_cast<std::size_t>(j)]]);
    schur(i, i) += closures_[p].by_pressure;
  }
  Eigen::VectorXd changes(count);
  if (count > 0) changes = schur.fullPivLu().solve(right);
  for (Eigen::Index j = 0; j < count; ++j)
    petsc(VecAXPY(particular_, changes[j], influences_[free[static_cast<std::size_t>(j)]]));

  const double* y = nullptr;
  petsc(VecGetArrayRead(particular_, &y));
  petsc(VecGetArrayWrite(solution, &data));
  std::fill_n(data, owned_components() + (rank_ == 0 ? body.plenum_count : 0), 0.0);
  std::copy_n(y, owned_components(), data);
  if (rank_ == 0) {
    for (std::size_t j = 0; j < free.size(); ++j) data[owned_components() + free[j]] = changes[static_cast<Eigen::Index>(j)];
  }
  petsc(VecRestoreArrayWrite(solution, &data));
  petsc(VecRestoreArrayRead(particular_, &y));
}

/// The full step, or as much of it as leaves every volume ratio positive.
void Equilibrium::Search::step(SNESLineSearch line_search) {
  Vec x = nullptr;
  Vec f = nullptr;
  Vec y = nullptr;
  Vec trial = nullptr;
  Vec trial_f = nullptr;
  petsc(SNESLineSearchGetVecs(line_search, &x, &f, &y, &trial, &trial_f));
  std::vector<double> from;
  std::vector<double> unused;
  unpack(x, from, unused);
  double length = 1.0;
  for (; length >= options_.smallest_step_length; length *= 0.5) {
    petsc(VecWAXPY(trial, -length, y, x));
    carry_along(trial, x, length);
    petsc(SNESComputeFunction(snes_, trial, trial_f));
    if (has_answer_) break;
  }
  if (singular_ || !has_answer_) {
    cut_to_nothing_ = !singular_;
    petsc(SNESLineSearchSetReason(line_search, SNES_LINESEARCH_FAILED_REDUCT));
    return;
  }
  std::vector<double> change = displacements_;
  double largest = 0.0;
  for (std::size_t n = 0; n < change.size(); ++n) {
    change[n] -= from[n];
    largest = std::max(largest, std::abs(change[n]));
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, space.communicator);
  if (largest > largest_step_m_ && largest_step_m_ > 0.0 && residual_N_ > residual_before_N_) ++growing_steps_;
  residual_before_N_ = residual_N_;
  runs_away_ = largest > 3.0 * diameter_m_ || growing_steps_ > most_growing_steps;
  largest_step_m_ = largest;
  if (options_.predict_pressure) assembly.elements().predict_pressure(from, change);
  petsc(VecCopy(trial, x));
  petsc(VecCopy(trial_f, f));
  double norm_x = 0.0;
  double norm_f = 0.0;
  double norm_y = 0.0;
  petsc(VecNorm(x, NORM_2, &norm_x));
  petsc(VecNorm(f, NORM_2, &norm_f));
  petsc(VecNorm(y, NORM_2, &norm_y));
  petsc(SNESLineSearchSetNorms(line_search, norm_x, norm_f, norm_y));
  petsc(SNESLineSearchSetReason(line_search, SNES_LINESEARCH_SUCCEEDED));
}

SNESConvergedReason Equilibrium::Search::convergence() const {
  if (stop_ != nullptr && stop_->load()) return SNES_DIVERGED_FUNCTION_COUNT;
  const std::vector<double> volumes = plenum_volumes(totals_);
  bool is_found = plate_distance_m_ == 0.0 && residual_N_ <= options_.relative_force_tolerance * reference_N_;
  for (std::size_t p = 0; p < body.plenum_count; ++p) {
    if (is_free(p) && std::abs(closures_[p].residual) > options_.relative_volume_tolerance * std::abs(volumes[p]))
      is_found = false;
  }
  if (is_found) return SNES_CONVERGED_FNORM_RELATIVE;
  return runs_away_ ? SNES_DIVERGED_DTOL : SNES_CONVERGED_ITERATING;
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

std::string Equilibrium::Search::failure_reason(int iterations) const {
  if (!is_held_) return "the stiffness is singular: the body is not held against every rigid motion";
  if (singular_) return "the linear system has no solution: its factorisation or its iteration has failed";
  if (runs_away_) return "Newton's steps grow instead of shrinking (after " + std::to_string(iterations) + " iterations)";
  return "no equilibrium within " + std::to_string(iterations) + " iterations";
}

EquilibriumReport Equilibrium::Search::report_of(SNESConvergedReason reason) {
  EquilibriumReport report;
  report.iterations = static_cast<int>(iterations_);
  report.residual_N = residual_N_;
  report.reference_force_N = reference_N_;
  report.totals = totals_;
  report.plenum_volumes_m3 = plenum_volumes(totals_);
  if (reason > 0) {
    report.status = io::RunStatus::completed;
  } else if (stop_ != nullptr && stop_->load()) {
    report.status = io::RunStatus::stopped;
    report.reason = "stopped by the user";
  } else if (cut_to_nothing_) {
    report.status = io::RunStatus::inverted_element;
    report.reason = "an element would turn inside out, or its law has no answer, however short the step";
  } else {
    report.status = io::RunStatus::not_converged;
    report.reason = failure_reason(report.iterations);
  }
  return report;
}

EquilibriumReport Equilibrium::Search::solve(BodyState& state, std::span<const PlenumControl> controls, double factor,
                                             std::span<const double> first_pressures, const std::atomic<bool>* stop) {
  assert(controls.size() == body.plenum_count);
  controls_ = controls;
  first_pressures_ = first_pressures;
  stop_ = stop;
  dead_load_factor = factor;
  singular_ = cut_to_nothing_ = runs_away_ = false;
  is_first_ = true;
  iterations_ = 0;
  largest_step_m_ = residual_before_N_ = 0.0;
  growing_steps_ = 0;
  for (std::size_t p = 0; p < controls.size(); ++p)
    if (const auto* given = std::get_if<PressureControl>(&controls[p])) state.plenum_pressures_Pa[p] = given->pressure_Pa;
  if (options_.predict_pressure && !state.element_pressures_Pa.empty()) {
    assembly.elements().set_predicted_pressures(state.element_pressures_Pa);
  } else {
    assembly.elements().forget_prediction();
  }
  const int earlier_factorisations = linear_.factorisations();
  pack(state, unknown_);
  function(unknown_, residual_vector_);
  if (!is_held_) {
    singular_ = true;
    return report_of(SNES_DIVERGED_LINEAR_SOLVE);
  }
  if (!has_answer_) {
    cut_to_nothing_ = true;
    return report_of(SNES_DIVERGED_FUNCTION_DOMAIN);
  }
  petsc(SNESSolve(snes_, nullptr, unknown_));
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  petsc(SNESGetConvergedReason(snes_, &reason));
  petsc(SNESGetIterationNumber(snes_, &iterations_));

  function(unknown_, residual_vector_);  // the last one may have been that of a rejected trial
  EquilibriumReport report = report_of(reason);
  report.factorisations = linear_.factorisations() - earlier_factorisations;
  if (report.factorisations > 0 && !singular_) report.negative_pivots = linear_.negative_pivots();
  state.displacements_m = displacements_;
  state.plenum_pressures_Pa = pressures_;
  if (options_.predict_pressure && has_answer_) {
    assembly.elements().predict_pressure(displacements_, std::vector<double>(displacements_.size(), 0.0));
    state.element_pressures_Pa = assembly.elements().predicted_pressures();
  }
  return report;
}

Equilibrium::Equilibrium(const Space& space, const Body& body, const EquilibriumOptions& options)
    : search_(std::make_unique<Search>(space, body, options)) {}

Equilibrium::~Equilibrium() = default;

BodyState Equilibrium::rest() const {
  BodyState state;
  state.displacements_m.assign(3 * search_->space.positions.size(), 0.0);
  state.plenum_pressures_Pa.assign(search_->body.plenum_count, 0.0);
  return state;
}

EquilibriumReport Equilibrium::solve(BodyState& state, std::span<const PlenumControl> controls, double dead_load_factor,
                                     std::span<const double> pressures_of_first_stiffness, const std::atomic<bool>* stop) {
  return search_->solve(state, controls, dead_load_factor, pressures_of_first_stiffness, stop);
}

BodyTotals Equilibrium::totals(const BodyState& state, double dead_load_factor) {
  search_->dead_load_factor = dead_load_factor;
  search_->assembly.elements().forget_prediction();
  return search_->assembly.assemble(state.displacements_m, {state.plenum_pressures_Pa, dead_load_factor}, {}, {}, nullptr);
}

void Equilibrium::move_plates(std::span<const PlateMotion> motions) { search_->move_plates(motions); }

std::optional<int> Equilibrium::count_negative_pivots(const BodyState& state, double dead_load_factor) {
  search_->dead_load_factor = dead_load_factor;
  return search_->count_negative_pivots(state);
}

std::vector<double> Equilibrium::plenum_volumes(const BodyTotals& totals) const { return search_->plenum_volumes(totals); }
Assembly& Equilibrium::assembly() { return search_->assembly; }
const Space& Equilibrium::space() const { return search_->space; }
const Body& Equilibrium::body() const { return search_->body; }

}  // namespace menger::fem
