#include "fem/implicit/implicit_dynamics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "fem/modes/mass_matrix.h"
#include "fem/space/space_diameter.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"

namespace menger::fem {
namespace {

void demand(bool is_met, const std::string& name, double value, const std::string& demand) {
  if (!is_met) throw io::InputError("implicit dynamics: " + name + " = " + io::number_text(value) + ": " + demand);
}

void check_ground(const RigidGround& ground) {
  const Friction& friction = ground.friction;
  demand(ground.stiffness_Pa_per_m > 0.0, "ground stiffness_Pa_per_m", ground.stiffness_Pa_per_m, "must be > 0");
  demand(friction.kinetic_coefficient >= 0.0, "kinetic_friction", friction.kinetic_coefficient, "must be >= 0");
  demand(friction.static_coefficient >= friction.kinetic_coefficient, "static_friction", friction.static_coefficient,
         "must not be below the kinetic one");
  demand(friction.regularisation_speed_m_per_s >= 0.0, "regularisation_speed_m_per_s", friction.regularisation_speed_m_per_s,
         "must be >= 0");
  if (!friction.directional) return;
  demand(friction.directional->backward_factor >= 0.0, "backward_factor", friction.directional->backward_factor, "must be >= 0");
  demand(friction.directional->sideways_factor >= 0.0, "sideways_factor", friction.directional->sideways_factor, "must be >= 0");
  const double length = std::hypot(friction.directional->forward[0], friction.directional->forward[1]);
  demand(std::abs(length - 1.0) <= 1e-9, "length of forward", length, "must be 1");
}

}  // namespace

ImplicitDynamics::ImplicitDynamics(const Space& space, const Body& body, ImplicitOptions options)
    : body_(body),
      options_(std::move(options)),
      scheme_(generalised_alpha(options_.spectral_radius)),
      assembly_(space, body),
      viscosity_(space, options_.viscosities_Pa_s),
      gaps_(space, body),
      linear_(assembly_, options_.linear),
      unknown_(linear_.make_vector()),
      newton_(unknown_, problem(), newton_options()),
      mass_(assembly_.make_matrix(true)),
      work_in_(linear_.make_vector()),
      work_out_(linear_.make_vector()) {
  if (options_.schedules.empty()) options_.schedules.resize(body.plenum_count);
  check(body);
  if (options_.ground) contact_.emplace(assembly_, body, *options_.ground, options_.stick_stiffness);
  options_.largest_step_s =
      std::min(options_.largest_step_s, longest_step_s(options_.schedules).value_or(options_.largest_step_s));
  tolerance_m_ = options_.tolerance * diameter_m(space);
  weigh();
  ImplicitState start;
  start.displacements_m.assign(3 * space.positions.size(), 0.0);
  start.velocities_m_per_s = start.displacements_m;
  set_state(std::move(start));
  first_volumes_ = forces_.totals.chamber_volumes_m3;
}

void ImplicitDynamics::check(const Body& body) const {
  const ImplicitOptions& o = options_;
  demand(o.mass_damping_per_s >= 0.0, "mass_damping_per_s", o.mass_damping_per_s, "must be >= 0");
  demand(o.stick_stiffness > 0.0, "stick_stiffness", o.stick_stiffness, "must be > 0");
  demand(o.spectral_radius >= 0.0 && o.spectral_radius <= 1.0, "spectral_radius", o.spectral_radius, "must be in [0, 1]");
  demand(o.tolerance > 0.0, "tolerance", o.tolerance, "must be > 0");
  demand(o.newton_tolerance > 0.0, "newton_tolerance", o.newton_tolerance, "must be > 0");
  demand(o.first_step_s > 0.0, "first_step_s", o.first_step_s, "must be > 0");
  demand(o.smallest_step_s > 0.0, "smallest_step_s", o.smallest_step_s, "must be > 0");
  demand(o.largest_step_s >= o.smallest_step_s, "largest_step_s", o.largest_step_s, "must not be below the smallest");
  demand(o.largest_volume_ratio > 1.0, "largest_volume_ratio", o.largest_volume_ratio, "must be > 1");
  for (const double viscosity : o.viscosities_Pa_s) demand(viscosity >= 0.0, "viscosity_Pa_s", viscosity, "must be >= 0");
  for (const RegionMaterial& region : body.regions)
    demand(region.density_kg_per_m3 > 0.0, "density_kg_per_m3", region.density_kg_per_m3, "must be > 0");
  if (o.schedules.size() != body.plenum_count)
    throw io::InputError("implicit dynamics: " + std::to_string(o.schedules.size()) + " schedules for " +
                         std::to_string(body.plenum_count) + " plena");
  if (!o.viscosities_Pa_s.empty() && o.viscosities_Pa_s.size() != body.regions.size())
    throw io::InputError("implicit dynamics: " + std::to_string(o.viscosities_Pa_s.size()) + " viscosities for " +
                         std::to_string(body.regions.size()) + " regions");
  if (!body.plates.empty()) throw io::InputError("implicit dynamics: plates are not moved in time");
  if (body.ground) throw io::InputError("implicit dynamics: the ground belongs to the options, not to the body");
  if (o.ground) check_ground(*o.ground);
}

void ImplicitDynamics::copy_owned(std::span<const double> field, Vec vector) const {
  const VectorWriter data(vector);
  std::copy_n(field.begin(), 3 * space().owned_count, data.data());
}

/// Copies a PETSc vector into a field and updates its ghosts.
/// @param field 3 per local node
void ImplicitDynamics::copy_owned(Vec vector, std::vector<double>& field) const {
  field.resize(3 * space().positions.size());
  {
    const VectorReader data(vector);
    std::copy_n(data.data(), 3 * space().owned_count, field.begin());
  }
  assembly_.exchange().update_ghosts(field);
}

double ImplicitDynamics::sum_over_ranks(double value) const {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, space().communicator);
  return value;
}

/// Computes the masses. The nodal masses are those of the body without supports.
void ImplicitDynamics::weigh() {
  mass_kg_ = mass_of(space(), body_);
  Body free = body_;
  free.supports.clear();
  free.point_supports.clear();
  const Assembly unheld(space(), free);
  const MatrixHandle mass = unheld.make_matrix(true);
  assemble_mass(unheld, free, mass);
  petsc(VecSet(work_in_, 1.0));
  petsc(MatMult(mass, work_in_, work_out_));
  const double* data = nullptr;
  petsc(VecGetArrayRead(work_out_, &data));
  masses_.resize(static_cast<std::size_t>(space().owned_count));
  for (std::size_t node = 0; node < masses_.size(); ++node) masses_[node] = data[3 * node];
  petsc(VecRestoreArrayRead(work_out_, &data));
  petsc(MatZeroEntries(mass_));
  add_masses(1.0, mass_);
}

/// Adds a multiple of the mass matrix to a matrix and assembles it.
void ImplicitDynamics::add_masses(double factor, Mat matrix) const {
  if (!options_.lumped_mass) {
    add_mass(assembly_, body_, factor, matrix);
    return;
  }
  for (std::size_t node = 0; node < masses_.size(); ++node) {
    const double m = factor * masses_[node];
    std::array<double, 9> block{m, 0.0, 0.0, 0.0, m, 0.0, 0.0, 0.0, m};
    const auto index = static_cast<Index>(node);
    assembly_.add_to_matrix(matrix, std::span(&index, 1), block);
  }
  petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

/// Returns the root mean square of a field, weighted by mass.
double ImplicitDynamics::size_of(std::span<const double> field) const {
  double square = 0.0;
  for (std::size_t n = 0; n < 3 * masses_.size(); ++n) square += masses_[n / 3] * field[n] * field[n];
  return std::sqrt(sum_over_ranks(square) / mass_kg_);
}

NewtonProblem ImplicitDynamics::problem() {
  return {.residual = [this](Vec x, Vec residual) { return compute_residual(x, residual); },
          .prepare_tangent = [this](Vec x) { return prepare_matrix(x); },
          .solve_tangent = [this](Vec b, Vec y) { return linear_.solve(b, y); },
          .check = [this](const NewtonIterate& iterate) { return check(iterate); }};
}

NewtonOptions ImplicitDynamics::newton_options() {
  const auto size = [this](Vec step) {
    const VectorReader data(step);
    return size_of(std::span(data.data(), 3 * masses_.size()));
  };
  return {.most_iterations = 20, .steps = BracketedSteps{}, .reuse = ReuseWhileStepsShrink{.step_size = size}};
}

void ImplicitDynamics::set_state(ImplicitState state) {
  const std::size_t count = 3 * space().positions.size();
  assert(state.displacements_m.size() == count && state.velocities_m_per_s.size() == count);
  state_ = std::move(state);
  report_ = {};
  for (std::size_t n = 0; n < count; ++n)
    if (assembly_.held()[n] != 0) state_.displacements_m[n] = state_.velocities_m_per_s[n] = 0.0;
  const bool remembers = !state_.ground_nodes.empty();
  if (contact_ && !remembers) state_.ground_nodes = contact_->free_nodes();
  assert(!contact_ || state_.ground_nodes.size() == contact_->free_nodes().size());
  const bool is_new = state_.accelerations_m_per_s2.empty();
  if (is_new) state_.accelerations_m_per_s2.assign(count, 0.0);
  trial_.time_s = state_.time_s;
  trial_.step_s = options_.first_step_s;
  trial_.accelerations = state_.accelerations_m_per_s2;
  trial_.velocities = state_.velocities_m_per_s;
  if (!compute_forces(state_.displacements_m, forces_, remembers))
    throw io::InputError("implicit dynamics: cannot start from this state: an element is inside out");
  state_.ground_nodes = forces_.ground_nodes;
  if (is_new) start_from_forces();
  if (state_.next_step_s == 0.0) state_.next_step_s = options_.first_step_s;
  newton_.forget_tangent();
  gap_m_.reset();
  gap_displacements_.clear();
  if (state_.at_start_J) return;
  state_.at_start_J = 0.0;
  state_.work = {};
  state_.work.contact_J = -(forces_.ground.normal_energy_J + forces_.ground.stick_energy_J);
  state_.at_start_J = energies().imbalance_J();
}

}  // namespace menger::fem
