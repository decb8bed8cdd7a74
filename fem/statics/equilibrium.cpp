#include "fem/statics/equilibrium.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "fem/space/space_diameter.h"
#include "fem/statics/dead_load.h"
#include "fem/statics/supports.h"

namespace menger::fem {

namespace {

/// The smallest reference load, divided by shear modulus x length^2. It makes the state at rest an equilibrium even without
/// loads.
constexpr double smallest_reference_load = 1e-4;
/// The number of steps at which both the step and the residual may grow in one search. After one of them the search may still
/// converge; after more it does not.
constexpr int most_growing_steps = 2;
constexpr double longest_step_by_diameter = 3.0;

int rank_in(MPI_Comm communicator) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  return rank;
}

}  // namespace

Equilibrium::Equilibrium(const Space& space, const Body& body, const EquilibriumOptions& options)
    : space_(space),
      body_(body),
      options_(options),
      rank_(rank_in(space.communicator)),
      assembly_(space, body),
      linear_(assembly_, options.linear),
      unknown_(make_unknowns()),
      newton_(unknown_, problem(), newton_options()),
      displacement_part_(linear_.make_vector()),
      particular_(linear_.make_vector()),
      is_held_(fem::is_held(space, body, assembly_.held())),
      diameter_m_(diameter_m(space)) {
  for (std::size_t p = 0; p < body.plenum_count; ++p) influences_.push_back(linear_.make_vector());
  // The softest region: beside a stiff one, a load that strains it must not count as no load.
  double modulus_Pa = std::numeric_limits<double>::infinity();
  for (const RegionMaterial& region : body.regions)
    modulus_Pa = std::min(modulus_Pa, materials::shear_modulus_at_rest_Pa(region.law));
  floor_N_ = smallest_reference_load * modulus_Pa * diameter_m_ * diameter_m_;
  std::vector<double> dead_load = dead_load_of(space, body);
  assembly_.exchange().add_from_ghosts(dead_load);
  dead_load_norm_N_ = norm_of_owned(dead_load);
  move_plates(std::vector<PlateMotion>(body.plates.size()));
}

VectorHandle Equilibrium::make_unknowns() const {
  const auto plena = static_cast<PetscInt>(body_.plenum_count);
  VectorHandle vector;
  petsc(VecCreateMPI(space_.communicator, 3 * space_.owned_count + (rank_ == 0 ? plena : 0), PETSC_DETERMINE, vector.receive()));
  return vector;
}

NewtonProblem Equilibrium::problem() {
  return {.residual = [this](Vec x, Vec residual) { return compute_residual(x, residual); },
          .prepare_tangent = [this](Vec x) { return prepare_stiffness(x); },
          .solve_tangent = [this](Vec b, Vec y) { return solve_linear(b, y); },
          .check = [this](const NewtonIterate&) { return check(); },
          .correct_trial = [this](Vec trial, Vec from, double length) { carry_along(trial, from, length); },
          .follow_step = [this](Vec from, Vec) { follow_step(from); }};
}

NewtonOptions Equilibrium::newton_options() const {
  return {.most_iterations = options_.largest_iteration_count,
          .steps = HalvedSteps{.shortest = options_.smallest_step_length},
          .reuse = ReuseWhileResidualFalls{.residual_size = [this] { return residual_N_; }}};
}

BodyState Equilibrium::rest() const {
  BodyState state;
  state.displacements_m.assign(3 * space_.positions.size(), 0.0);
  state.plenum_pressures_Pa.assign(body_.plenum_count, 0.0);
  return state;
}

void Equilibrium::move_plates(std::span<const PlateMotion> motions) {
  assert(motions.size() == body_.plates.size());
  motions_.assign(motions.begin(), motions.end());
  plate_components_.clear();
  for (std::size_t p = 0; p < body_.plates.size(); ++p) {
    for (const Index node : assembly_.plate_nodes(p)) {
      const auto local = static_cast<std::size_t>(node);
      const Point displacement = plate_displacement(body_.plates[p], motions_[p], space_.positions[local]);
      for (std::size_t i = 0; i < 3; ++i)
        if (body_.plates[p].held[i]) plate_components_.push_back({3 * local + i, displacement[i]});
    }
  }
}

std::vector<double> Equilibrium::plenum_volumes(const BodyTotals& totals) const {
  std::vector<double> volumes(body_.plenum_count, 0.0);
  for (std::size_t c = 0; c < body_.chambers.size(); ++c) volumes[body_.chambers[c].plenum] += totals.chamber_volumes_m3[c];
  return volumes;
}

BodyTotals Equilibrium::totals(const BodyState& state) {
  assembly_.elements().forget_prediction();
  return assembly_.assemble(state.displacements_m, {state.plenum_pressures_Pa}, {}, {}, nullptr);
}

std::optional<int> Equilibrium::count_negative_pivots(const BodyState& state, double dead_load_factor) {
  dead_load_factor_ = dead_load_factor;
  assembly_.elements().forget_prediction();
  plate_distance_m_ = 0.0;
  assemble_stiffness(state.displacements_m, state.plenum_pressures_Pa);
  return linear_.prepare() ? linear_.negative_pivots() : std::nullopt;
}

EquilibriumReport Equilibrium::solve(BodyState& state, std::span<const PlenumControl> controls, double dead_load_factor,
                                     std::span<const double> pressures_of_first_stiffness, const std::atomic<bool>* stop) {
  dead_load_factor_ = dead_load_factor;
  for (std::size_t p = 0; p < controls.size(); ++p)
    if (const auto* given = std::get_if<PressureControl>(&controls[p])) state.plenum_pressures_Pa[p] = given->pressure_Pa;
  begin(state, controls, pressures_of_first_stiffness);
  if (!is_held_) {
    evaluate(unknown_);
    return report_of({.end = NewtonEnd::linear_failure});
  }
  const NewtonOutcome outcome = newton_.solve(unknown_, stop);
  // The last evaluation may have been that of a rejected trial.
  const bool has_converged = outcome.end == NewtonEnd::solved || evaluate(unknown_);
  EquilibriumReport report = report_of(outcome);
  if (outcome.tangents > 0 && outcome.end != NewtonEnd::linear_failure) report.negative_pivots = linear_.negative_pivots();
  state.displacements_m = displacements_;
  state.plenum_pressures_Pa = pressures_;
  if (options_.predict_pressure && has_converged) {
    assembly_.elements().predict_pressure(displacements_, std::vector<double>(displacements_.size(), 0.0));
    state.element_pressures_Pa = assembly_.elements().predicted_pressures();
  }
  return report;
}

void Equilibrium::begin(const BodyState& state, std::span<const PlenumControl> controls,
                        std::span<const double> first_pressures) {
  assert(controls.size() == body_.plenum_count);
  controls_ = controls;
  first_pressures_ = first_pressures;
  largest_step_m_ = residual_before_N_ = 0.0;
  growing_steps_ = 0;
  runs_away_ = false;
  if (options_.predict_pressure && !state.element_pressures_Pa.empty()) {
    assembly_.elements().set_predicted_pressures(state.element_pressures_Pa);
  } else {
    assembly_.elements().forget_prediction();
  }
  pack(state, unknown_);
}

std::string Equilibrium::reason_of(const NewtonOutcome& outcome) const {
  if (!is_held_) return "the stiffness is singular: the body is not held against every rigid motion";
  switch (outcome.end) {
    case NewtonEnd::solved:
      return {};
    case NewtonEnd::stopped:
      return "stopped by the user";
    case NewtonEnd::no_residual:
      return "an element would turn inside out or be stretched beyond the limit of its law, however short the step";
    case NewtonEnd::linear_failure:
      return "the linear system has no solution: its factorisation or its iteration has failed";
    case NewtonEnd::diverging:
      return "Newton's steps grow instead of shrinking (after " + std::to_string(outcome.iterations) + " iterations)";
    default:
      return "no equilibrium within " + std::to_string(outcome.iterations) + " iterations";
  }
}

EquilibriumReport Equilibrium::report_of(const NewtonOutcome& outcome) const {
  EquilibriumReport report;
  report.status = outcome.status();
  report.reason = reason_of(outcome);
  report.iterations = outcome.iterations;
  report.factorisations = outcome.tangents;
  report.residual_N = residual_N_;
  report.reference_force_N = reference_N_;
  report.totals = totals_;
  report.plenum_volumes_m3 = plenum_volumes(totals_);
  return report;
}

void Equilibrium::unpack(Vec x, std::vector<double>& displacements, std::vector<double>& pressures) const {
  const VectorReader data(x);
  displacements.resize(3 * space_.positions.size());
  std::copy_n(data.data(), owned_components(), displacements.begin());
  pressures.resize(body_.plenum_count);
  if (rank_ == 0) std::copy_n(data.data() + owned_components(), body_.plenum_count, pressures.begin());
  assembly_.exchange().update_ghosts(displacements);
  MPI_Bcast(pressures.data(), static_cast<int>(pressures.size()), MPI_DOUBLE, 0, space_.communicator);
}

void Equilibrium::pack(const BodyState& state, Vec x) const {
  const VectorWriter data(x);
  for (std::size_t n = 0; n < owned_components(); ++n) data[n] = assembly_.held()[n] != 0 ? 0.0 : state.displacements_m[n];
  for (const PlateComponent& component : plate_components_) data[component.place] = state.displacements_m[component.place];
  if (rank_ == 0) std::copy(state.plenum_pressures_Pa.begin(), state.plenum_pressures_Pa.end(), data.data() + owned_components());
}

double Equilibrium::norm_of_owned(std::span<const double> field) const {
  double square = 0.0;
  for (std::size_t n = 0; n < owned_components(); ++n) square += field[n] * field[n];
  MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, space_.communicator);
  return std::sqrt(square);
}

/// Computes the residual, volumes and totals of a state. @return whether they exist
bool Equilibrium::evaluate(Vec x) {
  unpack(x, displacements_, pressures_);
  residual_.resize(displacements_.size());
  volume_gradients_.resize(body_.plenum_count);
  totals_ = assembly_.assemble(displacements_, loads(pressures_), residual_, volume_gradients_, nullptr);
  const bool are_closed = close_plena();
  std::vector<double> pressure_force(residual_.size(), 0.0);
  for (std::size_t p = 0; p < body_.plenum_count; ++p)
    for (std::size_t n = 0; n < pressure_force.size(); ++n) pressure_force[n] += pressures_[p] * volume_gradients_[p][n];
  residual_N_ = norm_of_owned(residual_);
  reference_N_ =
      std::max(floor_N_, norm_of_owned(pressure_force) + dead_load_factor_ * dead_load_norm_N_ + totals_.plate_force_norm_N);
  measure_plates();
  return are_closed && totals_.smallest_ratio > 0.0 && std::isfinite(totals_.strain_energy_J) && std::isfinite(residual_N_);
}

/// Evaluates the equation of every plenum. @return whether each can be evaluated
bool Equilibrium::close_plena() {
  const std::vector<double> volumes = plenum_volumes(totals_);
  closures_.assign(body_.plenum_count, {0.0, 1.0});
  bool are_closed = true;
  for (std::size_t p = 0; p < body_.plenum_count; ++p) {
    if (!is_free(p)) continue;
    const auto closure = plenum_closure(controls_[p], pressures_[p], volumes[p]);
    if (closure) closures_[p] = *closure;
    are_closed = are_closed && closure.has_value();
  }
  return are_closed;
}

void Equilibrium::measure_plates() {
  plate_distance_m_ = 0.0;
  for (const auto& [place, imposed_m] : plate_components_)
    plate_distance_m_ = std::max(plate_distance_m_, std::abs(displacements_[place] - imposed_m));
  MPI_Allreduce(MPI_IN_PLACE, &plate_distance_m_, 1, MPI_DOUBLE, MPI_MAX, space_.communicator);
}

bool Equilibrium::compute_residual(Vec x, Vec residual) {
  if (!evaluate(x)) return false;
  const VectorWriter data(residual);
  std::copy_n(residual_.begin(), owned_components(), data.data());
  for (const auto& [place, imposed_m] : plate_components_) data[place] = displacements_[place] - imposed_m;
  if (rank_ == 0) {
    for (std::size_t p = 0; p < body_.plenum_count; ++p) data[owned_components() + p] = closures_[p].residual;
  }
  return true;
}

void Equilibrium::assemble_stiffness(std::span<const double> displacements, std::span<const double> pressures) {
  if (plate_distance_m_ == 0.0) {
    assembly_.assemble(displacements, loads(pressures), {}, {}, linear_.matrix());
    return;
  }
  plate_step_m_.assign(displacements.size(), 0.0);
  plate_step_force_N_.assign(displacements.size(), 0.0);
  for (const auto& [place, imposed_m] : plate_components_) plate_step_m_[place] = displacements[place] - imposed_m;
  assembly_.exchange().update_ghosts(plate_step_m_);
  const HeldChange step{plate_step_m_, plate_step_force_N_};
  assembly_.assemble(displacements, loads(pressures), {}, {}, linear_.matrix(), &step);
}

bool Equilibrium::prepare_stiffness(Vec x) {
  unpack(x, displacements_, pressures_);
  assemble_stiffness(displacements_, first_pressures_.empty() ? pressures_ : first_pressures_);
  first_pressures_ = {};
  gradients_of_factor_ = volume_gradients_;
  if (!linear_.prepare()) return false;
  assembly_.read_volume_gradients(displacements_, gradients_of_factor_);
  for (std::size_t p = 0; p < body_.plenum_count; ++p) {
    if (!is_free(p)) continue;
    {
      const VectorWriter data(displacement_part_);
      std::copy_n(volume_gradients_[p].begin(), owned_components(), data.data());
    }
    if (!linear_.solve(displacement_part_, influences_[p])) return false;
  }
  return true;
}

/// Solves K y - sum_p W_p y_p = r, V_p . y + sum_q v_pq y_q + c_p y_p = c for every free plenum p, with the gradients W_p =
/// dW_p/du of its work volume and V_p = dV_p/du of its chambers, and v_pq = dV_p/dp_q, which is 0 but for thin walls. At
/// components that a plate holds y = r, and K y of these goes to the right-hand side. V_p leaves them out, which affects only the
/// first step of a plate.
bool Equilibrium::solve_linear(Vec right_hand_side, Vec solution) {
  {
    const VectorReader r(right_hand_side);
    const VectorWriter data(displacement_part_);
    std::copy_n(r.data(), owned_components(), data.data());
    if (plate_distance_m_ > 0.0)
      for (std::size_t n = 0; n < owned_components(); ++n) data[n] -= plate_step_force_N_[n];
  }
  if (!linear_.solve(displacement_part_, particular_)) return false;
  const std::vector<double> pressure_changes = eliminate_plena();
  const VectorReader y(particular_);
  const VectorWriter data(solution);
  std::copy_n(y.data(), owned_components(), data.data());
  if (rank_ == 0) std::copy(pressure_changes.begin(), pressure_changes.end(), data.data() + owned_components());
  return true;
}

/// Adds the part of the plena to K^-1 r, which gives the displacements y. @return y_p of each plenum, 0 where its pressure is
/// given
std::vector<double> Equilibrium::eliminate_plena() {
  std::vector<std::size_t> free;
  for (std::size_t p = 0; p < body_.plenum_count; ++p)
    if (is_free(p)) free.push_back(p);
  std::vector<double> result(body_.plenum_count, 0.0);
  if (free.empty()) return result;
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd schur(count, count);
  Eigen::VectorXd right(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t p = free[static_cast<std::size_t>(i)];
    right[i] = closures_[p].residual - times_gradient(p, particular_);
    for (Eigen::Index j = 0; j < count; ++j) {
      const std::size_t q = free[static_cast<std::size_t>(j)];
      schur(i, j) = times_gradient(p, influences_[q]) + assembly_.walls().volume_by_pressure(p, q);
    }
    schur(i, i) += closures_[p].by_pressure;
  }
  const Eigen::VectorXd changes = schur.fullPivLu().solve(right);
  for (Eigen::Index j = 0; j < count; ++j) {
    const std::size_t p = free[static_cast<std::size_t>(j)];
    petsc(VecAXPY(particular_, changes[j], influences_[p]));
    result[p] = changes[j];
  }
  return result;
}

/// The product of dV/du of a plenum, at the state of the factorisation, and a vector of displacements.
double Equilibrium::times_gradient(std::size_t plenum, Vec vector) const {
  const VectorReader values(vector);
  double sum = 0.0;
  for (std::size_t n = 0; n < owned_components(); ++n) sum += gradients_of_factor_[plenum][n] * values[n];
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, space_.communicator);
  return sum;
}

/// Sets the plates of a trial state exactly where a step of this length carries them. The arithmetic of the step would leave
/// rounding.
void Equilibrium::carry_along(Vec trial, Vec from, double length) const {
  const VectorReader before(from);
  const VectorWriter data(trial);
  for (const auto& [place, imposed_m] : plate_components_) data[place] = (1.0 - length) * before[place] + length * imposed_m;
}

/// Checks the sizes of steps for divergence, and predicts the pressures in the elements at the end of this step.
void Equilibrium::follow_step(Vec from) {
  std::vector<double> start;
  std::vector<double> unused;
  unpack(from, start, unused);
  std::vector<double> change = displacements_;
  double largest = 0.0;
  for (std::size_t n = 0; n < change.size(); ++n) {
    change[n] -= start[n];
    largest = std::max(largest, std::abs(change[n]));
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, space_.communicator);
  if (largest > largest_step_m_ && largest_step_m_ > 0.0 && residual_N_ > residual_before_N_) ++growing_steps_;
  residual_before_N_ = residual_N_;
  runs_away_ = largest > longest_step_by_diameter * diameter_m_ || growing_steps_ > most_growing_steps;
  largest_step_m_ = largest;
  if (options_.predict_pressure) assembly_.elements().predict_pressure(start, change);
}

NewtonVerdict Equilibrium::check() {
  const std::vector<double> volumes = plenum_volumes(totals_);
  bool is_found = plate_distance_m_ == 0.0 && residual_N_ <= options_.relative_force_tolerance * reference_N_;
  for (std::size_t p = 0; p < body_.plenum_count; ++p) {
    if (is_free(p) && std::abs(closures_[p].residual) > options_.relative_volume_tolerance * std::abs(volumes[p]))
      is_found = false;
  }
  if (is_found) return NewtonVerdict::solved;
  // The rest of a plate's distance enters the right-hand side together with a new stiffness.
  if (plate_distance_m_ > 0.0) newton_.forget_tangent();
  return runs_away_ ? NewtonVerdict::diverging : NewtonVerdict::go_on;
}

}  // namespace menger::fem
