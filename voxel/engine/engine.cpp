#include "voxel/engine/engine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "io/text/formatted.h"
#include "voxel/model/actuation.h"

namespace menger::voxel {

std::uint64_t steps_until(double time_s, double time_step_s) {
  // Rounding may leave the quotient one off in either direction.
  const double quotient = time_s / time_step_s;
  if (!(quotient < 1e18)) throw std::invalid_argument("too many steps to count");
  auto needed = quotient > 0.0 ? static_cast<std::uint64_t>(quotient) : 0;
  while (needed > 0 && static_cast<double>(needed - 1) * time_step_s >= time_s) --needed;
  while (static_cast<double>(needed) * time_step_s < time_s) ++needed;
  return needed;
}

template <class Real>
EngineOf<Real>::EngineOf(const meshes::Polycube& body, double cell_edge_m, const Physics& physics, const VoxelLoads& loads,
                         const KernelOptions& options)
    : options_(options),
      set_(resolve(options.instruction_set)),
      kernels_(kernels_for<Real>(set_)),
      moving_(VoxelBody(body, cell_edge_m, physics, loads.fixed), loads, kernels_, options) {
  choose_kernels();
  add_parts();
  report_body();
}

template <class Real>
void EngineOf<Real>::choose_kernels() {
  const Physics& physics = body().physics;
  const KeptTerms kept = options_.kept_terms();
  floor_ = (physics.floor && !body().hollow) || kept.floor;
  gravity_ = physics.gravity_m_s2 != 0.0 || kept.gravity;
  uniform_ = moving_.state().uniform() && !kept.coefficients;
  const bool velocity = physics.integration.damping == DampingMode::velocity;
  beams_ = kernels_.beams[velocity][static_cast<std::size_t>(variety(uniform_))];
  voxels_ = kernels_.voxels[uniform_][floor_][gravity_][moving_.sweep_drives()];
}

/// Creates what a step needs beside the two sweeps.
template <class Real>
void EngineOf<Real>::add_parts() {
  const VoxelBody& body = this->body();
  const Physics& physics = body.physics;
  if (body.hollow && physics.floor)
    feet_ = std::make_unique<FootContact<Real>>(body.lattice, *body.hollow, body.classes, -0.5 * body.edge_m);
  const double coupling = effective_coupling(physics);
  if (coupling != 0.0) {
    std::array<std::vector<double>, 3> axial_N;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::size_t beam : body.classes.beam_class[axis]) axial_N[axis].push_back(body.classes.beam[beam].axial);
    }
    coupling_ = std::make_unique<LateralCoupling<Real>>(body.lattice, coupling, axial_N);
  }
  if (!options_.energy_ledger) return;
  if constexpr (std::is_same_v<Real, double>) {
    const bool velocity = physics.integration.damping == DampingMode::velocity;
    balance_ = std::make_unique<EnergyBalance>(moving_.data(), variety(moving_.state().uniform()), velocity, floor_, gravity_,
                                               moving_.sweep_drives(), coupling_.get(), feet_.get());
    energy_.emplace();
  } else {
    throw std::invalid_argument("the energy balance needs float64");
  }
}

template <class Real>
void EngineOf<Real>::report_body() {
  const VoxelBody& body = this->body();
  const Physics& physics = body.physics;
  report_.push_back("kernels: " + std::string(to_string(set_)) + ", " + std::string(to_string(physics.integration.number)) +
                    ", damping from " + std::string(to_string(physics.integration.damping)));
  if (uniform_) {
    const std::vector<meshes::Material>& materials = body.lattice.material;
    const bool is_one = std::ranges::count(materials, materials.front()) == std::ranges::ssize(materials);
    report_.push_back(std::string("coefficients per voxel and beam left out: ") +
                      (is_one ? "all voxels are of one material and free"
                              : "all voxels are free, and both materials have the same properties: they differ in phase alone"));
  }
  if (body.hollow) {
    report_.push_back("calibrated body: classes: " + std::to_string(body.classes.voxel.size()) + " of voxels, " +
                      std::to_string(body.classes.beam.size()) + " of beams; " +
                      io::counted(body.hollow->chamber_count, "chamber"));
  }
  if (!coupling_) report_.push_back("lateral coupling left out: it is zero");
  if (options_.every_term) report_.push_back("every term is computed, as requested");
  const std::optional<int>& depth = physics.collisions.exclusion_depth;
  if (!depth) {
    report_.push_back("collisions left out: switched off");
  } else if (moving_.close_pairs() == nullptr) {
    report_.push_back("collisions left out: every pair of surface voxels is within " + std::to_string(*depth) +
                      " beams of each other");
  } else {
    report_.push_back("collisions: not computed while a bound on the displacements excludes contact");
  }
}

template <class Real>
std::vector<std::string> EngineOf<Real>::kernel_report() const {
  const Physics& physics = body().physics;
  std::vector<std::string> report = report_;
  if (!physics.floor && !floor_) report.push_back("floor left out: the scene has none");
  if (!gravity_) report.push_back("gravity left out: it is zero");
  if (!body().hollow && !is_driven(physics.actuation) && !moving_.sweep_drives())
    report.push_back("actuation left out: no size changes");
  return report;
}

template <class Real>
void EngineOf<Real>::add_contacts() {
  ClosePairs<Real>* pairs = moving_.close_pairs();
  if (pairs == nullptr) return;
  const StepData<Real>& d = moving_.data();
  pairs->renew(d.pose);
  if (!pairs->may_touch()) return;
  const VerletList& list = pairs->list();
  const auto size_of = [&](std::int32_t voxel) { return size_m(d, static_cast<std::size_t>(voxel)); };
  const ContactSearch<Real>& search = pairs->search(spheres_of(d), list.first().data(), list.second().data(), size_of);
  add_collision_loads(search.touching(spheres_of(d), 0, search.near_count(), touching_), list.pairs(), d);
}

template <class Real>
void EngineOf<Real>::step() {
  const StepData<Real>& d = moving_.data();
  moving_.begin_step();
  moving_.check_strains(balance_ ? balance_->add_beam_loads() : beams_(d));
  if (coupling_ && !balance_) coupling_->add_loads(d);
  add_contacts();
  if (feet_) feet_->add_loads(d, moving_.state().origin_m(), *moving_.pressures());
  const VoxelSweep seen = balance_ ? balance_->move_voxels() : voxels_(d);
  if (balance_) energy_ = balance_->ledger();
  moving_.end_step(seen, InLines{});
}

template <class Real>
io::RunStatus EngineOf<Real>::advance(std::uint64_t steps, const std::atomic<bool>* stop) {
  if (record().divergence) return io::RunStatus::diverged;
  for (std::uint64_t i = 0; i < steps; ++i) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) return io::RunStatus::stopped;
    step();
    if (moving_.record().divergence) return io::RunStatus::diverged;
  }
  return io::RunStatus::completed;
}

template <class Real>
Engine::VoxelView EngineOf<Real>::view(std::size_t voxel) const {
  const VoxelState<Real>& state = moving_.state();
  const Real* pose = state.data.pose + line_size * voxel;
  const Real* motion = state.data.motion + line_size * voxel;
  const auto number = [](Real value) { return static_cast<double>(value); };
  VoxelView v{};
  v.position_m = state.position_m(voxel);
  v.velocity_m_s = state.velocity_m_s(voxel);
  v.angular_velocity_rad_s = state.angular_velocity_rad_s(voxel);
  v.orientation = {number(pose[slot::qw]), number(pose[slot::qx]), number(pose[slot::qy]), number(pose[slot::qz])};
  v.size_m = number(pose[slot::size]);
  v.reach_m.fill(0.5 * v.size_m);
  if (moving_.pressures() != nullptr) v.reach_m = moving_.pressures()->reach_m(voxel);
  const bool on_feet = feet_ && record().steps > 0;  // before the first step the feet have not been evaluated
  v.is_static = on_feet ? feet_->sticks(voxel) : motion[slot::is_static] > Real(0.5);
  v.touches_floor =
      on_feet ? feet_->touches(voxel) : body().physics.floor && 0.5 * v.size_m - 0.5 * body().edge_m - v.position_m[2] >= 0.0;
  return v;
}

template <class Real>
std::vector<double> EngineOf<Real>::strains() const {
  const VoxelState<Real>& state = moving_.state();
  std::vector<double> largest(body().lattice.voxel_count(), 0.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = body().lattice.beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const auto lower = static_cast<std::size_t>(beams.lower[i]);
      const auto upper = static_cast<std::size_t>(beams.upper[i]);
      const std::array<double, 3> from = state.position_m(lower);
      const std::array<double, 3> to = state.position_m(upper);
      const double length = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
      const double strain = length / moving_.rest_length_m(axis, i) - 1.0;
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
    const BeamAxisData<Real>& beams = moving_.data().axis[axis];
    const Real* small = beams.history + (history_values - 1) * beams.count;
    for (std::size_t i = 0; i < body().lattice.beams[axis].lower.size(); ++i) count += small[i] < Real(0.5) ? 1 : 0;
  }
  return count;
}

template <class Real>
std::vector<bool> EngineOf<Real>::in_contact_with_others() const {
  std::vector<bool> touching(body().lattice.voxel_count(), false);
  if (moving_.close_pairs() == nullptr) return touching;
  const VoxelState<Real>& state = moving_.state();
  for (const auto& [first, second] : moving_.close_pairs()->list().pairs()) {
    const auto a = static_cast<std::size_t>(first);
    const auto b = static_cast<std::size_t>(second);
    const std::array<double, 3> from = state.position_m(a);
    const std::array<double, 3> to = state.position_m(b);
    const double distance = std::hypot(from[0] - to[0], from[1] - to[1], from[2] - to[2]);
    const double sizes = static_cast<double>(size_m(state.data, a)) + static_cast<double>(size_m(state.data, b));
    if (distance >= collision_radius_fraction * sizes) continue;
    touching[a] = true;
    touching[b] = true;
  }
  return touching;
}

template <class Real>
CollisionCounts EngineOf<Real>::collision_counts() const {
  return moving_.close_pairs() != nullptr ? moving_.close_pairs()->counts() : CollisionCounts{};
}

template class EngineOf<double>;
template class EngineOf<float>;

}  // namespace menger::voxel
