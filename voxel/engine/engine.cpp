#include "voxel/engine/engine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "voxel/engine/time_step.h"
#include "voxel/kernels/instruction_sets.h"
#include "voxel/lanes/block_lanes.h"
#include "voxel/lanes/lane_packing.h"
#include "voxel/model/actuation.h"

namespace menger::voxel {

namespace {

constexpr double list_skin_edges =
    0.4;  ///< of the Verlet list, in voxel edges: the flat optimum between long lists and frequent rebuilds

constexpr auto line_size = static_cast<std::size_t>(line_length);

/// Putting a body's blocks into lanes and taking them out again costs about a step.
constexpr std::uint64_t fewest_steps_in_blocks = 16;

/// Above it, as measured with AVX-512, blocks are no faster in double precision for one thread: waiting for memory is what takes
/// the time.
constexpr std::size_t most_voxels_in_blocks = 10000;

/// Fastest wave of the stiffest and lightest material of a body of solid voxels.
double wave_speed_m_s(const Lattice& lattice, const Physics& physics) {
  double fastest = 0.0;
  for (const meshes::Material material : lattice.material) {
    const VoxelMaterial& m = physics.materials[static_cast<std::size_t>(material - 1)];
    fastest = std::max(fastest, std::sqrt(m.youngs_modulus_Pa / m.density_kg_m3));
  }
  return fastest;
}

/// The same of a calibrated body, as if every voxel with its mass went on for ever along its stiffest axis.
double wave_speed_m_s(const HollowVoxels& voxels, const BodyClasses& classes, const SurrogateParameters& parameters) {
  const double edge = parameters.voxel_edge_m();
  double fastest = 0.0;
  for (std::size_t i = 0; i < classes.mass_kg.size(); ++i) {
    for (const std::uint8_t c : voxels.wall_class[i])
      fastest = std::max(fastest, std::sqrt(parameters.axial_Pa[c] * edge * edge * edge / classes.mass_kg[i]));
  }
  return fastest;
}

}  // namespace

template <class Real>
EngineOf<Real>::EngineOf(const meshes::Polycube& body, double edge_m, const Physics& given, const VoxelLoads& loads,
                         const KernelOptions& options) {
  physics = given;
  if (physics.surrogate) hollow_ = calibrated_voxels(body, *physics.surrogate);
  lattice = std::make_unique<Lattice>(hollow_ ? hollow_->body : body);
  cell_edge_m = physics.surrogate ? physics.surrogate->parameters.voxel_edge_m() : edge_m;
  classes_ = hollow_ ? calibrated_classes(*lattice, *hollow_, physics, loads.fixed)
                     : solid_classes(*lattice, cell_edge_m, physics, loads.fixed);
  state_ = std::make_unique<VoxelState<Real>>(*lattice, cell_edge_m, physics, loads, classes_, hollow_.has_value());
  phases = state_->phases();
  mass_kg = classes_.mass_kg;
  const double coupling = effective_coupling(physics);
  time_step_s =
      physics.integration.time_step_fraction * (hollow_ ? recommended_time_step_s(*lattice, classes_, cell_edge_m, physics)
                                                        : recommended_time_step_s(*lattice, cell_edge_m, physics));
  speed_limit_m_s_ = physics.limits.speed_fraction * (hollow_ ? wave_speed_m_s(*hollow_, classes_, physics.surrogate->parameters)
                                                              : wave_speed_m_s(*lattice, physics));

  StepData<Real>& d = state_->data;
  floor_depth_m_ = 0.5 * cell_edge_m;
  d.floor_depth = static_cast<Real>(floor_depth_m_ + state_->origin_m()[2]);
  d.time_step = static_cast<Real>(time_step_s);
  d.rate_scale = Real(0);
  d.angular_frequency = static_cast<Real>(2.0 * std::numbers::pi / physics.actuation.period_s);
  d.strain_limit = static_cast<Real>(physics.limits.strain);
  d.displacement_limit2 = static_cast<Real>(speed_limit_m_s_ * time_step_s * speed_limit_m_s_ * time_step_s);
  d.stop_rotation_in_static_friction = physics.stop_rotation_in_static_friction;
  d.single_precision_rest_lengths = physics.integration.single_precision_rest_lengths;
  choose_kernels(options);
  prepare_collisions(loads);
  prepare_drive();
  if (coupling != 0.0) {
    std::array<std::vector<double>, 3> axial_N;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::size_t beam : classes_.beam_class[axis]) axial_N[axis].push_back(classes_.beam[beam].axial);
    }
    coupling_ = std::make_unique<LateralCoupling<Real>>(*lattice, coupling, axial_N);
  }
  if constexpr (std::is_same_v<Real, double>) {
    if (options.energy_ledger) {
      books_ = std::make_unique<EnergyBooks>(d, variety(state_->uniform()), physics.integration.damping == DampingMode::velocity,
                                             floor_, gravity_, actuated_, coupling_.get(), feet_.get());
      energy.emplace();
    }
  } else if (options.energy_ledger) {
    throw std::invalid_argument("the energy ledger needs float64");
  }
  blocks_in_lanes_ = options.blocks_in_lanes;
  threads_ = options.threads;
  prepare_blocks();
  report_left_out_terms();
}

template <class Real>
EngineOf<Real>::~EngineOf() = default;

template <class Real>
void EngineOf<Real>::prepare_drive() {
  shaped_ = is_shaped(physics.actuation) && is_driven(physics.actuation) && !hollow_;
  if (hollow_) {
    pressures_ = std::make_unique<PressureDrive<Real>>(*lattice, *hollow_, *physics.surrogate, physics.actuation, phases);
    strain_range.emplace();
  }
  if (hollow_ && physics.floor) feet_ = std::make_unique<FootContact<Real>>(*lattice, *hollow_, classes_, -0.5 * cell_edge_m);
  if (pressures_ || shaped_) {
    drive_to(0.0);
  } else {
    const DriveAngle start = drive_angle(0.0, physics.actuation.period_s);
    state_->set_sizes(start.sine, start.cosine);
  }
}

/// Sizes and rest lengths that the kernels do not compute.
template <class Real>
void EngineOf<Real>::drive_to(double time_s) {
  if (pressures_) pressures_->set(time_s, state_->data);
  if (shaped_) state_->set_sizes(drive_moment(physics.actuation, time_s));
}

template <class Real>
void EngineOf<Real>::choose_kernels(const KernelOptions& options) {
  every_term_ = options.every_term;
  kept_ = every_term_ ? all_terms : options.kept;
  // The feet of a calibrated body find the floor themselves; see FootContact.
  const bool seen_by_kernels = physics.floor && !hollow_;
  floor_ = seen_by_kernels || kept_.floor;
  gravity_ = physics.gravity_m_s2 != 0.0 || kept_.gravity;
  const bool is_sine = is_driven(physics.actuation) && !is_shaped(physics.actuation) && !hollow_;
  actuated_ = is_sine || kept_.actuation;
  // A floor that is kept in the loop where there is none for it lies infinitely deep.
  if (!seen_by_kernels) {
    floor_depth_m_ = std::numeric_limits<double>::infinity();
    state_->data.floor_depth = std::numeric_limits<Real>::infinity();
  }

  const InstructionSet set = resolve(options.instruction_set);
  const StepKernels<Real>& kernels = kernels_for<Real>(set);
  set_ = set;
  kernels_ = &kernels;
  const bool uniform = state_->uniform() && !kept_.coefficients;
  beams_ = kernels.beams[physics.integration.damping == DampingMode::velocity][static_cast<std::size_t>(variety(uniform))];
  voxels_ = kernels.voxels[uniform][floor_][gravity_][actuated_];

  report_.push_back("kernels: " + std::string(to_string(set)) + ", " + std::string(to_string(physics.integration.number)) +
                    ", damping from " + std::string(to_string(physics.integration.damping)));
  if (uniform) report_.push_back("coefficients per voxel and beam left out: all voxels are of one material and free");
  if (hollow_) {
    report_.push_back("calibrated body: " + std::to_string(classes_.voxel.size()) + " classes of voxels, " +
                      std::to_string(classes_.beam.size()) + " of beams, " + std::to_string(hollow_->chamber_count) +
                      " chambers");
  }
  if (effective_coupling(physics) == 0.0) report_.push_back("lateral coupling left out: it is zero");
  if (every_term_) report_.push_back("every term kept in the loop on request");
}

template <class Real>
void EngineOf<Real>::prepare_collisions(const VoxelLoads& loads) {
  if (!physics.collisions.exclusion_depth) {
    report_.push_back("collisions left out: switched off");
    return;
  }
  CollisionRule rule(*lattice, *physics.collisions.exclusion_depth);
  if (rule.excludes_every_pair() && !kept_.collisions) {
    report_.push_back("collisions left out: every pair of surface voxels is within " +
                      std::to_string(*physics.collisions.exclusion_depth) + " beams of each other");
    return;
  }
  double largest_factor = 1.0;
  for (const double factor : loads.size_factor) largest_factor = std::max(largest_factor, factor);
  const double amplitude = is_driven(physics.actuation) ? physics.actuation.amplitude : 0.0;
  const double largest_size =
      hollow_ ? largest_collision_size_m(*hollow_, *physics.surrogate) : cell_edge_m * largest_factor * (1.0 + amplitude);
  close_pairs_ = std::make_unique<VerletList>(std::move(rule), 2.0 * collision_radius_fraction * largest_size,
                                              list_skin_edges * cell_edge_m);
  largest_size_m_ = largest_size;
  contacts_ = std::make_unique<ContactSearch<Real>>(*kernels_);
  find_kinds();
  report_.push_back("collisions: work is skipped while a bound on the displacements rules contact out");
}

/// Renews the list of close pairs where it must be. @return whether any of them may touch
template <class Real>
bool EngineOf<Real>::looks_at_pairs() {
  const Real* pose = state_->data.pose;
  if (every_term_) {
    close_pairs_->build(pose, line_size);
    ++collision_counts.list_rebuilds;
  } else if (close_pairs_->refresh(pose, line_size)) {
    ++collision_counts.list_rebuilds;
  }
  collision_counts.pairs_in_list = close_pairs_->pairs().size();
  if (close_pairs_->contact_ruled_out() && !kept_.collisions) {
    ++collision_counts.steps_skipped;
    return false;
  }
  ++collision_counts.steps_with_pairs;
  return true;
}

template <class Real>
void EngineOf<Real>::add_collisions() {
  if (!close_pairs_ || !looks_at_pairs()) return;
  const StepData<Real>& d = state_->data;
  const std::array<double, 2> sizes =
      sizes_of_kinds([&](std::int32_t voxel) { return size_m(d, static_cast<std::size_t>(voxel)); });
  const VerletList& list = *close_pairs_;
  contacts_->prepare(list, spheres_of(d), list.first().data(), list.second().data(), sizes);
  add_collision_loads(contacts_->touching(spheres_of(d), 0, contacts_->near_count(), touching_), list.pairs(), d);
}

/// Tells voxels of two drives apart for the list of close pairs.
template <class Real>
void EngineOf<Real>::find_kinds() {
  if (hollow_) return;
  const StepData<Real>& d = state_->data;
  const auto same = [&](std::size_t a, std::size_t b) {
    return d.size_base[a] == d.size_base[b] && d.size_sine_part[a] == d.size_sine_part[b] &&
           d.size_cosine_part[a] == d.size_cosine_part[b];
  };
  std::vector<std::uint8_t> kind(d.voxels, 0);
  std::size_t other = 0;
  for (std::size_t i = 1; i < d.voxels; ++i) {
    if (same(i, 0)) continue;
    if (other == 0) other = i;
    if (!same(i, other)) return;
    kind[i] = 1;
  }
  of_kind_ = {0, static_cast<std::int32_t>(other)};
  close_pairs_->set_kinds(std::move(kind));
}

/// Terms whose kernels are others without them. Blocks in lanes have but one kernel.
template <class Real>
void EngineOf<Real>::report_left_out_terms() {
  if (blocks_) return;
  if (!physics.floor && !floor_) report_.push_back("floor left out: the scene has none");
  if (!gravity_) report_.push_back("gravity left out: it is zero");
  if (!hollow_ && !is_driven(physics.actuation) && !actuated_) report_.push_back("actuation left out: no size changes");
}

/// Whether blocks in lanes are faster than voxel by voxel on as many threads as there are now.
template <class Real>
bool EngineOf<Real>::blocks_pay() const {
  return std::is_same_v<Real, float> || threads_ > 1 || lattice->voxel_count() <= most_voxels_in_blocks;
}

/// Puts an aggregate's blocks into lanes where that is faster.
template <class Real>
void EngineOf<Real>::prepare_blocks() {
  if (blocks_ || !blocks_in_lanes_ || !blocks_pay() || !runs_in_lanes() || !state_->uniform()) return;
  std::optional<BlockBody> body = blocks_of(*lattice);
  if (!body) return;
  const LaneKernels<Real>* kernels = kernels_for_blocks<Real>(set_, body->count);
  if (kernels == nullptr) return;
  report_.push_back("blocks of the aggregate in lanes: " + std::to_string(body->count) + " in registers of " +
                    std::to_string(kernels->lanes));
  blocks_ = std::make_unique<BlockLanes<Real>>(*this, std::move(*body), *kernels, threads_);
}

template <class Real>
bool EngineOf<Real>::runs_in_lanes() const {
  return voxel::runs_in_lanes(physics) && !books_ && kept_ == KeptTerms{} && !divergence && state_->data.external_load == nullptr;
}

/// Whether a step of this displacement makes the way since the origin was last looked at long enough to look again. Only where
/// positions are rounded to single precision: in double a kilometre costs a tenth of a picometre.
template <class Real>
bool EngineOf<Real>::looks_at_origin_after(double displacement_m) const {
  return std::is_same_v<Real, float> && way_m_ + displacement_m >= cell_edge_m;
}

/// Takes the origin of positions along once the body is far from it.
template <class Real>
void EngineOf<Real>::stay_near_origin(double largest_displacement_m) {
  if constexpr (std::is_same_v<Real, float>) {
    const bool looks = looks_at_origin_after(largest_displacement_m);
    way_m_ += largest_displacement_m;
    if (!looks) return;
    way_m_ = 0.0;
    if (!state_->take_origin_along()) return;
    state_->data.floor_depth = static_cast<Real>(floor_depth_m_ + state_->origin_m()[2]);
    if (!close_pairs_) return;
    // The list remembers positions from the origin that was.
    close_pairs_->build(state_->data.pose, line_size);
    ++collision_counts.list_rebuilds;
  }
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
  if (pressures_) check_validity();
  if (coupling_ && !books_) coupling_->add_loads(d);
  add_collisions();
  if (feet_) feet_->add_loads(d, state_->origin_m(), *pressures_);
  const VoxelSweep seen = books_ ? books_->move_voxels() : voxels_(d);
  if (books_) energy = books_->ledger();
  const double largest_displacement_m = std::sqrt(seen.largest_displacement2);
  if (close_pairs_) close_pairs_->moved(largest_displacement_m);
  if (!seen.out_of_range) stay_near_origin(largest_displacement_m);
  d.rate_scale = static_cast<Real>(1.0 / time_step_s);
  ++steps;
  if (pressures_ || shaped_) drive_to(static_cast<double>(steps) * time_step_s);
  if (seen.out_of_range) note_speed();
  if (divergence) divergence->time_s = static_cast<double>(steps) * time_step_s;
  return !divergence;
}

template <class Real>
void EngineOf<Real>::set_threads(int threads) {
  threads_ = threads;
  prepare_blocks();
  if (blocks_) blocks_->set_threads(threads);
}

template <class Real>
io::RunStatus EngineOf<Real>::advance(std::uint64_t count, const std::atomic<bool>* stop) {
  if (divergence) return io::RunStatus::diverged;
  if (blocks_ && blocks_pay() && count >= fewest_steps_in_blocks) {
    const std::uint64_t end = steps + count;
    blocks_->advance(count, stop);
    if (divergence) return io::RunStatus::diverged;
    return steps == end ? io::RunStatus::completed : io::RunStatus::stopped;
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) return io::RunStatus::stopped;
    if (!step()) return io::RunStatus::diverged;
  }
  return io::RunStatus::completed;
}

template class EngineOf<double>;
template class EngineOf<float>;

}  // namespace menger::voxel
