#include "voxel/engine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "voxel/actuation.h"
#include "voxel/instruction_sets.h"
#include "voxel/time_step.h"

namespace menger::voxel {

namespace {

constexpr double list_skin_edges =
    0.4;  ///< of the Verlet list, in voxel edges: the flat optimum between long lists and frequent rebuilds

constexpr auto line_size = static_cast<std::size_t>(line_length);

}  // namespace

template <class Real>
EngineOf<Real>::EngineOf(const meshes::Polycube& body, double edge_m, const Physics& given, const VoxelLoads& loads,
                         const KernelOptions& options) {
  lattice = std::make_unique<Lattice>(body);
  physics = given;
  cell_edge_m = edge_m;
  tables_ = class_tables(physics, edge_m);
  state_ = std::make_unique<VoxelState<Real>>(*lattice, edge_m, physics, loads, tables_);
  phases = state_->phases();
  for (const meshes::Material material : lattice->material)
    mass_kg.push_back(tables_.mass_kg[static_cast<std::size_t>(material - 1)]);
  time_step_s = physics.integration.time_step_fraction * recommended_time_step_s(*lattice, edge_m, physics);

  double wave_speed = 0.0;
  for (const meshes::Material material : lattice->material) {
    const VoxelMaterial& m = physics.materials[static_cast<std::size_t>(material - 1)];
    wave_speed = std::max(wave_speed, std::sqrt(m.youngs_modulus_Pa / m.density_kg_m3));
  }
  speed_limit_m_s_ = physics.limits.speed_fraction * wave_speed;

  StepData<Real>& d = state_->data;
  d.half_edge = static_cast<Real>(0.5 * edge_m);
  d.time_step = static_cast<Real>(time_step_s);
  d.rate_scale = Real(0);
  d.angular_frequency = static_cast<Real>(2.0 * std::numbers::pi / physics.actuation.period_s);
  d.strain_limit = static_cast<Real>(physics.limits.strain);
  d.displacement_limit2 = static_cast<Real>(speed_limit_m_s_ * time_step_s * speed_limit_m_s_ * time_step_s);
  d.stop_rotation_in_static_friction = physics.stop_rotation_in_static_friction;
  d.single_precision_rest_lengths = physics.integration.single_precision_rest_lengths;
  choose_kernels(options);
  prepare_collisions(loads);
  const DriveAngle start = drive_angle(0.0, physics.actuation.period_s);
  state_->set_sizes(start.sine, start.cosine);
  if constexpr (std::is_same_v<Real, double>) {
    if (options.energy_ledger) {
      books_ = std::make_unique<EnergyBooks>(d, state_->uniform(), physics.integration.damping == DampingMode::velocity, floor_,
                                             gravity_, actuated_);
      energy.emplace();
    }
  } else if (options.energy_ledger) {
    throw std::invalid_argument("the energy ledger needs float64");
  }
}

template <class Real>
void EngineOf<Real>::choose_kernels(const KernelOptions& options) {
  every_term_ = options.every_term;
  floor_ = physics.floor || every_term_;
  gravity_ = physics.gravity_m_s2 != 0.0 || every_term_;
  actuated_ = is_driven(physics.actuation) || every_term_;
  // A floor that is kept in the loop for comparison only lies infinitely deep.
  if (!physics.floor && floor_) state_->data.half_edge = std::numeric_limits<Real>::infinity();

  const InstructionSet set = resolve<Real>(options.instruction_set);
  const StepKernels<Real>& kernels = kernels_for<Real>(set);
  const bool uniform = state_->uniform() && !every_term_;
  beams_ = kernels.beams[physics.integration.damping == DampingMode::velocity][uniform];
  voxels_ = kernels.voxels[uniform][floor_][gravity_][actuated_];

  report_.push_back("kernels: " + std::string(to_string(set)) + ", " + std::string(to_string(physics.integration.number)) +
                    ", damping from " + std::string(to_string(physics.integration.damping)));
  if (uniform) report_.push_back("coefficients per voxel and beam left out: all voxels are of one material and free");
  if (!floor_) report_.push_back("floor left out: the scene has none");
  if (!gravity_) report_.push_back("gravity left out: it is zero");
  if (!actuated_) report_.push_back("actuation left out: no size changes");
  if (every_term_) report_.push_back("every term kept in the loop on request");
}

template <class Real>
void EngineOf<Real>::prepare_collisions(const VoxelLoads& loads) {
  if (!physics.collisions.exclusion_depth) {
    report_.push_back("collisions left out: switched off");
    return;
  }
  CollisionRule rule(*lattice, *physics.collisions.exclusion_depth);
  if (rule.excludes_every_pair() && !every_term_) {
    report_.push_back("collisions left out: every pair of surface voxels is within " +
                      std::to_string(*physics.collisions.exclusion_depth) + " beams of each other");
    return;
  }
  double largest_factor = 1.0;
  for (const double factor : loads.size_factor) largest_factor = std::max(largest_factor, factor);
  const double amplitude = is_driven(physics.actuation) ? physics.actuation.amplitude : 0.0;
  const double largest_size = cell_edge_m * largest_factor * (1.0 + amplitude);
  close_pairs_ = std::make_unique<VerletList>(std::move(rule), 2.0 * collision_radius_fraction * largest_size,
                                              list_skin_edges * cell_edge_m);
  report_.push_back("collisions: work is skipped while a bound on the displacements rules contact out");
}

template <class Real>
void EngineOf<Real>::add_collisions() {
  if (!close_pairs_) return;
  const Real* pose = state_->data.pose;
  if (every_term_) {
    close_pairs_->build(pose, line_size);
    ++collision_counts.list_rebuilds;
  } else if (close_pairs_->refresh(pose, line_size)) {
    ++collision_counts.list_rebuilds;
  }
  collision_counts.pairs_in_list = close_pairs_->pairs().size();
  if (close_pairs_->contact_ruled_out() && !every_term_) {
    ++collision_counts.steps_skipped;
    return;
  }
  ++collision_counts.steps_with_pairs;
  add_collision_loads(close_pairs_->pairs(), state_->data);
}

template <class Real>
bool EngineOf<Real>::step() {
  StepData<Real>& d = state_->data;
  if (actuated_) {
    const DriveAngle next = drive_angle(static_cast<double>(steps + 1) * time_step_s, physics.actuation.period_s);
    d.next_sine = static_cast<Real>(next.sine);
    d.next_cosine = static_cast<Real>(next.cosine);
  }
  const bool strained = books_ ? books_->add_beam_loads() : beams_(d);
  if (strained) note_strain();
  add_collisions();
  const VoxelSweep seen = books_ ? books_->move_voxels() : voxels_(d);
  if (books_) energy = books_->ledger();
  if (close_pairs_) close_pairs_->moved(std::sqrt(seen.largest_displacement2));
  d.rate_scale = static_cast<Real>(1.0 / time_step_s);
  ++steps;
  if (seen.out_of_range) note_speed();
  if (divergence) divergence->time_s = static_cast<double>(steps) * time_step_s;
  return !divergence;
}

template <class Real>
io::RunStatus EngineOf<Real>::advance(std::uint64_t count, const std::atomic<bool>* stop) {
  if (divergence) return io::RunStatus::diverged;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) return io::RunStatus::stopped;
    if (!step()) return io::RunStatus::diverged;
  }
  return io::RunStatus::completed;
}

/// Of the beams as they are in this step, before sizes and positions move on.
template <class Real>
void EngineOf<Real>::note_strain() {
  Divergence found{.voxel = 0, .cell = {}, .quantity = "strain", .value = 0.0, .limit = physics.limits.strain, .time_s = 0.0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice->beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const double strain = static_cast<double>(state_->data.axis[axis].history[i]) / rest_length(axis, i);
      if (std::abs(strain) <= std::abs(*found.value)) continue;
      found.voxel = static_cast<std::size_t>(beams.lower[i]);
      if (!std::isfinite(strain)) {
        found.quantity = "not finite";
        found.value.reset();
        found.cell = lattice->cells[found.voxel];
        divergence = found;
        return;
      }
      found.value = strain;
    }
  }
  found.cell = lattice->cells[found.voxel];
  divergence = found;
}

template <class Real>
void EngineOf<Real>::note_speed() {
  Divergence found{.voxel = 0, .cell = {}, .quantity = "speed", .value = 0.0, .limit = speed_limit_m_s_, .time_s = 0.0};
  for (std::size_t i = 0; i < lattice->voxel_count(); ++i) {
    const VoxelView voxel = view(i);
    const double speed = std::hypot(voxel.velocity_m_s[0], voxel.velocity_m_s[1], voxel.velocity_m_s[2]);
    if (speed <= *found.value) continue;
    found.voxel = i;
    found.value = speed;
    if (std::isfinite(speed)) continue;
    found.quantity = "not finite";
    found.value.reset();
    break;
  }
  found.cell = lattice->cells[found.voxel];
  divergence = found;
}

template <class Real>
double EngineOf<Real>::rest_length(std::size_t axis, std::size_t beam) const {
  const auto size = [&](std::int32_t voxel) {
    return static_cast<double>(state_->data.pose[line_size * static_cast<std::size_t>(voxel) + slot::size]);
  };
  return 0.5 * (size(lattice->beams[axis].lower[beam]) + size(lattice->beams[axis].upper[beam]));
}

template <class Real>
Simulation::Engine::VoxelView EngineOf<Real>::view(std::size_t voxel) const {
  const Real* pose = state_->data.pose + line_size * voxel;
  const Real* motion = state_->data.motion + line_size * voxel;
  const Real* coefficients = state_->data.voxel_table + line_size * static_cast<std::size_t>(state_->data.voxel_class[voxel]);
  const auto inverse_mass = static_cast<double>(coefficients[class_slot::inverse_mass]);
  const auto inverse_inertia = static_cast<double>(coefficients[class_slot::inverse_inertia]);
  const auto number = [](Real value) { return static_cast<double>(value); };
  VoxelView v{};
  v.position_m = {number(pose[slot::x]), number(pose[slot::y]), number(pose[slot::z])};
  v.velocity_m_s = {inverse_mass * number(motion[slot::px]), inverse_mass * number(motion[slot::py]),
                    inverse_mass * number(motion[slot::pz])};
  v.angular_velocity_rad_s = {inverse_inertia * number(motion[slot::hx]), inverse_inertia * number(motion[slot::hy]),
                              inverse_inertia * number(motion[slot::hz])};
  v.orientation = {number(pose[slot::qw]), number(pose[slot::qx]), number(pose[slot::qy]), number(pose[slot::qz])};
  v.size_m = number(pose[slot::size]);
  v.is_static = motion[slot::is_static] > Real(0.5);
  return v;
}

template <class Real>
std::vector<double> EngineOf<Real>::strains() const {
  std::vector<double> largest(lattice->voxel_count(), 0.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice->beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const auto lower = static_cast<std::size_t>(beams.lower[i]);
      const auto upper = static_cast<std::size_t>(beams.upper[i]);
      const std::array<double, 3> from = view(lower).position_m;
      const std::array<double, 3> to = view(upper).position_m;
      const double strain = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]) / rest_length(axis, i) - 1.0;
      for (const std::size_t end : {lower, upper}) {
        if (std::abs(strain) > std::abs(largest[end])) largest[end] = strain;
      }
    }
  }
  return largest;
}

template <class Real>
std::size_t EngineOf<Real>::large_angle_beams() const {
  std::size_t count = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BeamAxisData<Real>& beams = state_->data.axis[axis];
    const Real* small = beams.history + (history_values - 1) * beams.count;
    for (std::size_t i = 0; i < lattice->beams[axis].lower.size(); ++i) count += small[i] < Real(0.5) ? 1 : 0;
  }
  return count;
}

template <class Real>
std::vector<bool> EngineOf<Real>::in_contact_with_others() const {
  std::vector<bool> touching(lattice->voxel_count(), false);
  if (!close_pairs_) return touching;
  for (const auto& [first, second] : close_pairs_->pairs()) {
    const VoxelView a = view(static_cast<std::size_t>(first));
    const VoxelView b = view(static_cast<std::size_t>(second));
    const double distance =
        std::hypot(a.position_m[0] - b.position_m[0], a.position_m[1] - b.position_m[1], a.position_m[2] - b.position_m[2]);
    if (distance >= collision_radius_fraction * (a.size_m + b.size_m)) continue;
    touching[static_cast<std::size_t>(first)] = true;
    touching[static_cast<std::size_t>(second)] = true;
  }
  return touching;
}

template <class Real>
std::vector<std::string> EngineOf<Real>::kernel_report() const {
  return report_;
}

template class EngineOf<double>;
template class EngineOf<float>;

}  // namespace menger::voxel
