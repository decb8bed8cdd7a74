#include "fem/explicit/explicit_dynamics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "fem/explicit/explicit_contact.h"
#include "fem/motion/state_check.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::fem {
namespace {

constexpr std::size_t batches_per_block = 8;
constexpr std::size_t face_batches_per_block = 64;
constexpr std::size_t nodes_per_block = 256;
constexpr std::size_t components_per_block = 4096;

/// Time between relaxations over the shortest relaxation time. The branch's dynamic modulus is then within 8e-4 of that of the
/// material where it dissipates most; a longer time would show in motion more than the branch's data are known.
constexpr double relaxation_share = 0.08;

/// Smallest step over that without branches for which a branch that relaxes fast may shorten it.
constexpr double least_step_share = 0.1;

void demand(bool is_met, const std::string& name, double value, const std::string& demand) {
  if (!is_met) throw io::InputError("explicit dynamics: " + name + " = " + io::number_text(value) + ": " + demand);
}

SurfaceFriction self_friction(const ExplicitOptions& options) {
  if (!options.self_contact) return {};
  if (options.self_contact->friction) return *options.self_contact->friction;
  if (!options.loads.ground) return {};
  const Friction& ground = options.loads.ground->friction;
  return {ground.static_coefficient, ground.kinetic_coefficient};
}

double self_stiffness_Pa_per_m(const ExplicitBody& body, const ExplicitOptions& options) {
  if (options.self_contact && options.self_contact->stiffness_Pa_per_m) return *options.self_contact->stiffness_Pa_per_m;
  return self_contact_stiffness_Pa_per_m(body.elements().contact_modulus_Pa(), body.smallest_edge_m());
}

/// A stiffness that somebody has asked for stays what it is.
TouchLimit touch_limit(const ExplicitBody& body, const ExplicitOptions& options) {
  if (options.self_contact && options.self_contact->stiffness_Pa_per_m) return {};
  return {body.masses_kg(),
          touch_limit_per_s2(self_stiffness_Pa_per_m(body, options), body.smallest_density_kg_per_m3(), body.smallest_edge_m())};
}

}  // namespace

ExplicitDynamics::ExplicitDynamics(const meshes::HexahedralMesh& mesh, const ExplicitBody& body, ExplicitOptions options)
    : body_(body),
      options_(std::move(options)),
      chambers_(mesh),
      self_contact_(mesh, self_stiffness_Pa_per_m(body, options_), options_.self_contact.has_value(), self_friction(options_),
                    touch_limit(body, options_)),
      areas_(outer_node_areas_m2(mesh)),
      nodes_(body_, chambers_, options_.loads, areas_),
      loop_(options_.threads),
      element_forces_(body.elements().make_forces()) {
  if (!options_.supply) {
    if (options_.schedules.empty()) options_.schedules.resize(chambers_.plenum_count());
    options_.supply.emplace(std::vector<PlenumSupply>(options_.schedules.begin(), options_.schedules.end()));
  } else if (!options_.schedules.empty()) {
    throw io::InputError("explicit dynamics: there are schedules and a supply of all plena: keep one of them");
  }
  check(mesh);
  if (options_.supply->has_lines()) air_.emplace(*options_.supply);
  if (!body.elements().take_pressure()) chamber_slots_.resize(chambers_.number_count());
  face_volumes_m3_.resize(chambers_.batch_count());
  outcomes_.resize(BlockLoop::block_count(element_forces_->batch_count(), batches_per_block));
  moves_.resize(BlockLoop::block_count(body.node_count(), nodes_per_block));
  current_positions_.resize(3 * body.node_count() + 1);  // kernels read one number more
  first_volumes_ = chambers_.volumes_m3(body.reference_positions_m());
  first_plenum_volumes_m3_ = chambers_.plenum_sums(first_volumes_);
  clearances_m_.resize(NodeUpdate::block_count(body.node_count()));
  touched_blocks_.resize(clearances_m_.size());
  energy_noise_ = 1e-10 * body.stiffness_J();
  ExplicitState start;
  start.displacements_m.assign(3 * body.node_count(), 0.0);
  start.velocities_m_per_s = start.displacements_m;
  if (const auto shortest = body.shortest_relaxation_time_s()) relaxation_interval_s_ = relaxation_share * *shortest;
  eigenvalues_.emplace(body_, loop_, *element_forces_);
  if (options_.loads.ground) {
    ground_springs_.resize(3 * body.node_count(), 0.0);
    for (std::size_t node = 0; node < areas_.size(); ++node)
      ground_springs_[3 * node + 2] = options_.loads.ground->stiffness_Pa_per_m * areas_[node];
  }
  set_state(std::move(start));
  rest_stable_step_ = state_.stable_step_s;
  const double step_s = std::min(options_.step_safety * rest_stable_step_, longest_step_s());
  if (step_s < least_step_share * options_.step_safety * rest_stable_step_ && step_s == relaxation_interval_s_) {
    throw UnresolvedRelaxation("a Maxwell branch relaxes within " + io::number_text(*body.shortest_relaxation_time_s()) +
                               " s, which needs steps of " + io::number_text(step_s) + " s: less than a tenth of the " +
                               io::number_text(options_.step_safety * rest_stable_step_) + " s that the body allows");
  }
  options_.supply->check_resolved(mesh.plenum_names, step_s);
}

void ExplicitDynamics::check(const meshes::HexahedralMesh& mesh) const {
  const ExplicitOptions& o = options_;
  demand(o.step_safety > 0.0 && o.step_safety <= 1.0, "step_safety", o.step_safety, "must be in (0, 1]");
  demand(!o.largest_step_s || *o.largest_step_s > 0.0, "largest_step_s", o.largest_step_s.value_or(0.0), "must be > 0");
  demand(o.steps_per_bound >= 1, "steps_per_bound", static_cast<double>(o.steps_per_bound), "must be >= 1");
  demand(o.largest_imbalance > 0.0, "largest_imbalance", o.largest_imbalance, "must be > 0");
  demand(o.largest_volume_ratio > 1.0, "largest_volume_ratio", o.largest_volume_ratio, "must be > 1");
  demand(o.smallest_step_ratio > 0.0 && o.smallest_step_ratio < 1.0, "smallest_step_ratio", o.smallest_step_ratio,
         "must be in (0, 1)");
  demand(o.threads >= 1, "threads", o.threads, "must be >= 1");
  if (o.step_taker && o.supply->has_lines())
    throw io::InputError("explicit dynamics: steps cannot be left to " + o.step_taker->text() +
                         ": air flows through lines, which need the volumes at each step");
  if (o.self_contact && o.self_contact->stiffness_Pa_per_m)
    demand(*o.self_contact->stiffness_Pa_per_m > 0.0, "self-contact stiffness_Pa_per_m", *o.self_contact->stiffness_Pa_per_m,
           "must be > 0");
  if (o.self_contact && o.self_contact->friction) {
    const auto [static_coefficient, kinetic_coefficient] = *o.self_contact->friction;
    demand(kinetic_coefficient >= 0.0, "self_contact_kinetic_friction", kinetic_coefficient, "must be >= 0");
    demand(static_coefficient >= kinetic_coefficient, "self_contact_static_friction", static_coefficient,
           "must not be below the kinetic one");
  }
  demand(o.loads.mass_damping_per_s >= 0.0, "mass_damping_per_s", o.loads.mass_damping_per_s, "must be >= 0");
  if (o.supply->plenum_count() != mesh.plenum_names.size())
    throw io::InputError("explicit dynamics: " + std::to_string(o.supply->plenum_count()) + " schedules for " +
                         std::to_string(mesh.plenum_names.size()) + " plena");
  if (!o.loads.ground) return;
  const RigidGround& ground = *o.loads.ground;
  demand(ground.stiffness_Pa_per_m > 0.0, "ground stiffness_Pa_per_m", ground.stiffness_Pa_per_m, "must be > 0");
  demand(ground.friction.kinetic_coefficient >= 0.0, "kinetic_friction", ground.friction.kinetic_coefficient, "must be >= 0");
  demand(ground.friction.static_coefficient >= ground.friction.kinetic_coefficient, "static_friction",
         ground.friction.static_coefficient, "must not be below the kinetic one");
  demand(ground.friction.regularisation_speed_m_per_s >= 0.0, "regularisation_speed_m_per_s",
         ground.friction.regularisation_speed_m_per_s, "must be >= 0");
  if (!ground.friction.directional) return;
  const DirectionalFriction& directional = *ground.friction.directional;
  demand(directional.backward_factor >= 0.0, "backward_factor", directional.backward_factor, "must be >= 0");
  demand(directional.sideways_factor >= 0.0, "sideways_factor", directional.sideways_factor, "must be >= 0");
  const double length = std::hypot(directional.forward[0], directional.forward[1]);
  demand(std::abs(length - 1.0) <= 1e-9, "length of forward", length, "must be 1");
}

void ExplicitDynamics::set_state(ExplicitState state) {
  assert(state.displacements_m.size() == 3 * body_.node_count() && state.velocities_m_per_s.size() == 3 * body_.node_count());
  state_ = std::move(state);
  energies_.reset();
  report_ = {};
  if (body_.elements().failed_element(state_.displacements_m))
    throw io::InputError("explicit dynamics: cannot start from this state: " + failure_in_element().reason);
  for (std::size_t n = 0; n < state_.velocities_m_per_s.size(); ++n)
    if (body_.inverse_masses_per_kg()[n] == 0.0) state_.velocities_m_per_s[n] = 0.0;
  if (!state_.pneumatics || !options_.supply->has_lines())
    state_.pneumatics = options_.supply->start(state_.time_s, plenum_volumes_m3());
  if (!state_.branches) state_.branches = BranchState{body_.elements().branches_at_rest(state_.displacements_m)};
  self_contact_.forget();
  clearances_m_.assign(clearances_m_.size(), 0.0);
  if (state_.pressures_Pa.empty()) {
    compute_forces();
    state_.pressures_Pa = pressures_Pa_;
    state_.pressed_volumes = pressed_volumes_;
  }
  set_current_positions();
  find_touches();
  if (!state_.contact) state_.contact = self_contact_.memories();
  if (state_.stable_step_s == 0.0) {
    state_.stable_step_s = stable_step();
    state_.steps_since_bound = 0;
  }
  if (state_.at_start_J) return;
  state_.at_start_J = 0.0;
  state_.at_start_J = energies().imbalance_J();
  state_.turnover_J = energies().turnover_J();
}

std::string ExplicitDynamics::misfit(const ExplicitState& state) const {
  StateCheck check;
  const std::size_t components = state_.displacements_m.size();
  check.numbers("displacements_m", state.displacements_m, components)
      .numbers("velocities_m_per_s", state.velocities_m_per_s, components)
      .finite("time_s", {state.time_s, state.last_step_s, state.stable_step_s, state.step_share})
      .expect(state.last_step_s >= 0.0 && state.stable_step_s >= 0.0 && state.step_share > 0.0 && state.step_share <= 1.0 &&
                  state.steps_to_bound > 0,
              "the length of its steps is out of range")
      .work(state.work)
      .finite("energy", {state.at_start_J.value_or(0.0), state.turnover_J});
  if (state.pneumatics && options_.supply->has_lines()) {
    const PneumaticState& air = *state.pneumatics;
    check.finite("air", {air.time_s, air.work.piston_J, air.work.source_J, air.work.plenum_J, air.work.line_J})
        .numbers("volumes_m3", air.volumes_m3, state_.pneumatics->volumes_m3.size())
        .numbers("plenum_air_m3", air.plenum_air_m3, state_.pneumatics->plenum_air_m3.size())
        .numbers("piston_air_m3", air.piston_air_m3, state_.pneumatics->piston_air_m3.size())
        .numbers("source_air_m3", air.source_air_m3, state_.pneumatics->source_air_m3.size());
  }
  if (state.contact) check.expect(self_contact_.can_have(*state.contact), "contact is not that of the body's surface");
  if (state.branches) {
    check.expect(state.branches->numbers.index() == state_.branches->numbers.index(), "branches are of another precision")
        .finite("branches", {state.branches->age_s});
    std::visit(
        [&](const auto& rest) {
          using Numbers = std::decay_t<decltype(rest)>;
          if (const auto* numbers = std::get_if<Numbers>(&state.branches->numbers))
            check.numbers("branches", *numbers, rest.size());
        },
        state_.branches->numbers);
  }
  if (!state.pressures_Pa.empty()) {
    check.numbers("pressures_Pa", state.pressures_Pa, state_.pressures_Pa.size())
        .numbers("pressed_volumes", state.pressed_volumes.walls_m3, state_.pressed_volumes.walls_m3.size())
        .numbers("pressed_volumes", state.pressed_volumes.chambers_m3, state_.pressed_volumes.chambers_m3.size());
  }
  if (!check.reason().empty()) return check.reason();
  const std::optional<FailedElement> failed = body_.elements().failed_element(state.displacements_m);
  return failed ? "element " + std::to_string(failed->element) + " is inverted, or its law gives no stress" : "";
}

/// Returns the time by which branches relax at the start of a step: the time since they last relaxed if it is longer than the
/// relaxation interval minus half a step, otherwise 0.
double ExplicitDynamics::due_relaxation_s(double step_s) const {
  const double age = state_.branches->age_s;
  return relaxation_interval_s_ && age + 0.5 * step_s > *relaxation_interval_s_ ? age : 0.0;
}

/// Computes the forces of the state.
/// @return whether no element has failed
bool ExplicitDynamics::compute_forces(double relaxed_s) {
  set_pressures();
  if (!elements_follow_) element_forces_->place({state_.displacements_m.data(), state_.velocities_m_per_s.data()}, loop_);
  loop_.run(element_forces_->batch_count(), batches_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    outcomes_[block] = element_forces_->compute({begin, end}, state_.branches->numbers, relaxed_s);
  });
  pressed_volumes_ = element_forces_->pressed_volumes();
  const bool push_chambers = chambers_.chamber_count() > 0 && !body_.elements().take_pressure();
  if (push_chambers || (self_contact_.is_awake() && self_contact_.reads_all_nodes())) {
    set_current_positions();
  } else if (self_contact_.is_awake()) {
    set_followed_positions();
  }
  if (push_chambers) {
    loop_.run(chambers_.batch_count(), face_batches_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      chambers_.set_face_forces(current_positions_, pressures_Pa_, {begin, end}, chamber_slots_, face_volumes_m3_);
    });
    chambers_.set_cap_forces(current_positions_, pressures_Pa_, chamber_slots_);
    pressed_volumes_.chambers_m3 = chambers_.plenum_volumes_m3(current_positions_, face_volumes_m3_);
    for (std::size_t p = 0; p < first_plenum_volumes_m3_.size(); ++p)
      pressed_volumes_.chambers_m3[p] -= first_plenum_volumes_m3_[p];
  }
  const bool has_failed =
      std::any_of(outcomes_.begin(), outcomes_.end(), [](const ForcesOutcome& outcome) { return outcome.has_failed; });
  if (self_contact_.is_awake() && !has_failed) find_touches();  // positions that are not finite have no neighbours
  has_failed_element_ = has_failed;
  return !has_failed;
}

/// Sets the pressures to those at the time of the state, and tells them to the elements.
void ExplicitDynamics::set_pressures() {
  pressures_Pa_ = options_.supply->pressures_Pa(*state_.pneumatics);
  element_forces_->press(pressures_Pa_);
}

/// Adds the work of the change of pressures since the last step: the energy of a pressure is minus pressure times change of
/// volume, so that a change of pressure does work where nothing moves. The mean of the changes of volume at both times counts;
/// those of the forces that were computed last stand for this one.
void ExplicitDynamics::add_work_of_pressure_changes(MotionWork& work) const {
  const auto work_on = [&](const std::vector<double>& now_m3, const std::vector<double>& before_m3) {
    double sum = 0.0;
    for (std::size_t p = 0; p < pressures_Pa_.size(); ++p)
      sum -= 0.5 * (now_m3[p] + before_m3[p]) * (pressures_Pa_[p] - state_.pressures_Pa[p]);
    return sum;
  };
  work.wall_pressure_J += work_on(pressed_volumes_.walls_m3, state_.pressed_volumes.walls_m3);
  work.pressure_J += work_on(pressed_volumes_.chambers_m3, state_.pressed_volumes.chambers_m3);
}

/// Searches the contacts of the current positions. The state does not change: its memory of contact stays that of the time before
/// it until a step is taken.
void ExplicitDynamics::find_touches() {
  const std::span<const double> positions(current_positions_.data(), 3 * body_.node_count());
  if (!state_.contact) return self_contact_.find_touches(positions, loop_);
  const ContactPast past{*state_.contact, state_.velocities_m_per_s, state_.last_step_s};
  self_contact_.find_touches(positions, loop_, &past);
}

void ExplicitDynamics::set_current_positions() {
  loop_.run(3 * body_.node_count(), components_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      current_positions_[n] = body_.reference_positions_m()[n] + state_.displacements_m[n];
  });
}

/// Sets the current positions of the nodes that self-contact follows.
void ExplicitDynamics::set_followed_positions() {
  for (const std::uint32_t node : self_contact_.followed_nodes())
    for (std::size_t n = 3 * std::size_t{node}; n < 3 * std::size_t{node} + 3; ++n)
      current_positions_[n] = body_.reference_positions_m()[n] + state_.displacements_m[n];
}

void ExplicitDynamics::set_touched_blocks() {
  std::fill(touched_blocks_.begin(), touched_blocks_.end(), '\0');
  for (const SelfTouch& touch : self_contact_.touches()) {
    touched_blocks_[touch.node / NodeUpdate::nodes_at_once] = 1;
    for (const std::uint32_t node : touch.face_nodes) touched_blocks_[node / NodeUpdate::nodes_at_once] = 1;
  }
}

NodesOutcome ExplicitDynamics::move(const StepTimes& times, std::vector<double>& displacements, std::vector<double>& velocities,
                                    ElementForces* followers) {
  BodyForces forces{.elements = *element_forces_, .followers = followers};
  if (!body_.elements().take_pressure()) forces.chamber_slots_N = chamber_slots_;
  if (options_.self_contact && !self_contact_.touches().empty()) {
    forces.self_contact_N = self_contact_.forces_N();
    forces.self_friction_N = self_contact_.friction_N();
    set_touched_blocks();
    forces.touched_blocks = touched_blocks_;
  }
  loop_.run(body_.node_count(), nodes_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    moves_[block] = nodes_.move(forces, times, {begin, end}, displacements, velocities, clearances_m_);
  });
  NodesOutcome all;
  for (const NodesOutcome& part : moves_) {
    all.work += part.work;
    all.speed_bound_square_m2_per_s2 = std::max(all.speed_bound_square_m2_per_s2, part.speed_bound_square_m2_per_s2);
  }
  for (const ForcesOutcome& outcome : outcomes_) all.work.viscous_J += times.kick_s * outcome.dissipated_W + outcome.relaxed_J;
  add_work_of_pressure_changes(all.work);
  return all;
}

bool ExplicitDynamics::take_step(double step_s) {
  energies_.reset();
  const bool has_looked = self_contact_.is_awake();
  const double relaxed_s = due_relaxation_s(step_s);
  if (!compute_forces(relaxed_s)) return false;
  state_.branches->age_s = (relaxed_s > 0.0 ? 0.0 : state_.branches->age_s) + step_s;
  if (has_looked) *state_.contact = self_contact_.memories();
  const StepTimes times{0.5 * (state_.last_step_s + step_s), step_s, common_velocity_};
  const NodesOutcome outcome = move(times, state_.displacements_m, state_.velocities_m_per_s, element_forces_.get());
  state_.work += outcome.work;
  state_.pressures_Pa = pressures_Pa_;
  state_.pressed_volumes = pressed_volumes_;
  double travel_m = step_s * std::sqrt(outcome.speed_bound_square_m2_per_s2);
  if (travel_m > self_contact_.allowed_travel_m()) travel_m = step_s * largest_speed_m_per_s();
  self_contact_.moved(travel_m);
  state_.last_step_s = step_s;
  ++state_.steps;
  return true;
}

/// Returns the largest speed of a node, relative to the common velocity.
double ExplicitDynamics::largest_speed_m_per_s() const {
  double largest_square = 0.0;
  const std::vector<double>& v = state_.velocities_m_per_s;
  for (std::size_t n = 0; n < v.size(); n += 3) {
    const Point apart = difference({v[n], v[n + 1], v[n + 2]}, common_velocity_);
    largest_square = std::max(largest_square, dot(apart, apart));
  }
  return std::sqrt(largest_square);
}

ExplicitDynamics::HalfStep ExplicitDynamics::half_step() {
  HalfStep half{state_.velocities_m_per_s, {}};
  compute_forces();
  std::vector<double> displacements = state_.displacements_m;
  half.work = move({0.5 * state_.last_step_s, 0.0, {}}, displacements, half.velocities).work;
  return half;
}

ExplicitReport ExplicitDynamics::failure(io::RunStatus status, const std::string& reason) const {
  return {status, reason + " at " + io::shown(state_.time_s) + " s", std::nullopt};
}

ExplicitReport ExplicitDynamics::failure_in_element() const {
  const std::optional<FailedElement> failed = body_.elements().failed_element(state_.displacements_m);
  if (!failed) return failure(io::RunStatus::diverged, "forces that are not finite");
  const std::string where = "element " + std::to_string(failed->element) + " at " + meshes::millimetre_text(failed->position_m);
  ExplicitReport report = failed->is_finite
                              ? failure(io::RunStatus::inverted_element, where + " was crushed or turned inside out")
                              : failure(io::RunStatus::diverged, where + " has displacements that are not finite");
  report.failed_element = failed->element;
  return report;
}

}  // namespace menger::fem
