#include "fem/statics/equilibrium.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "fem/space/space_diameter.h"
#include "fem/statics/dead_load.h"
#include "fem/statics/equilibrium_search.h"
#include "fem/statics/supports.h"

namespace menger::fem {

namespace {

/// Part of (shear modulus x length^2) that counts as load even without any, so that the state at rest is an equilibrium.
constexpr double smallest_reference_load = 1e-4;

}  // namespace

Equilibrium::Search::Search(const Space& the_space, const Body& the_body, const EquilibriumOptions& options)
    : space(the_space),
      body(the_body),
      assembly(the_space, the_body),
      options_(options),
      linear_(assembly, options.linear),
      is_held_(fem::is_held(the_space, the_body, assembly.held())),
      diameter_m_(diameter_m(the_space)) {
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
