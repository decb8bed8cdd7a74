#include "fem/explicit/explicit_nodes.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace menger::fem {
namespace {

/// Returns the sum of the forces in a node's slots. The forces of later nodes are prefetched, as they do not lie in the nearest
/// caches.
inline Point sum_of(const NodeSlots& slots, std::span<const double> forces, std::size_t node) {
  const double* values = forces.data();
  const std::size_t stride = slots.stride;
  const std::uint32_t* slot = slots.slots.data() + slots.offsets[node];
  const std::uint32_t* end = slots.slots.data() + slots.offsets[node + 1];
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  for (; slot != end; ++slot) {
    const double* later = values + slot[NodeSlots::padding];
    __builtin_prefetch(later);
    __builtin_prefetch(later + stride);
    __builtin_prefetch(later + 2 * stride);
    const double* value = values + *slot;
    x += value[0];
    y += value[stride];
    z += value[2 * stride];
  }
  return {x, y, z};
}

/// The coefficients of a kick: v1 = kept v0 + time_s f / m, where time_s is dt / (1 + a dt/2).
struct Kick {
  double kept;
  double share;  ///< 1 / (1 + a dt/2)
  double time_s;
};

/// Returns the kick of a duration dt. Mass damping acts on the mean of both velocities: (1 + a dt/2) v1 = (1 - a dt/2) v0 + dt
/// f/m.
Kick kick_of(double time_s, double mass_damping_per_s) {
  const double damping = 0.5 * time_s * mass_damping_per_s;
  const double share = 1.0 / (1.0 + damping);
  return {(1.0 - damping) * share, share, time_s * share};
}

/// Applies friction to the velocity that all other forces would give.
/// @param after that velocity, changed
/// @return the energy lost, J
double apply_friction(const Friction& friction, const Kick& kick, double normal_N, double mass, const double* before,
                      double* after) {
  const double change = kick.time_s * normal_N / mass;
  const auto slid = velocity_after_friction(friction, {before[0], before[1]}, {after[0], after[1]}, change);
  double lost = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const double impulse = mass * (slid[i] - after[i]) / kick.share;
    lost -= impulse * 0.5 * (before[i] + slid[i]);
    after[i] = slid[i];
  }
  return lost;
}

/// Returns the sum of products. The order of summation does not depend on the width of the registers: each index modulo the
/// number of lanes has its own sum.
double product_sum(const double* a, const double* b, std::size_t count) {
  constexpr std::size_t lanes = 8;
  std::array<double, lanes> sums{};
  const std::size_t whole = count / lanes * lanes;
  for (std::size_t n = 0; n < whole; n += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += a[n + lane] * b[n + lane];
  for (std::size_t n = whole; n < count; ++n) sums[n - whole] += a[n] * b[n];
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double largest_speed_square(const double* velocities, std::size_t count, const Point& common_velocity) {
  double largest = 0.0;
  for (std::size_t n = 0; n < count; n += 3) {
    const Point apart = difference({velocities[n], velocities[n + 1], velocities[n + 2]}, common_velocity);
    largest = std::max(largest, dot(apart, apart));
  }
  return largest;
}

constexpr std::size_t nodes_per_block = 128;

}  // namespace

/// A block of nodes during a step; component i of its nth node at 3 n + i. Loops over whole arrays use vector registers, and give
/// the same numbers for any register width.
struct NodeUpdate::Block {
  std::size_t first = 0;  ///< first component in the body
  std::size_t count = 0;  ///< of components
  std::array<double, 3 * nodes_per_block> pressure_N;
  std::array<double, 3 * nodes_per_block> load_N;
  std::array<double, 3 * nodes_per_block> after_m_per_s;
  std::array<double, 3 * nodes_per_block> mean_m_per_s;
  std::size_t standing_count = 0;                     ///< number of nodes that the ground pushes
  std::array<std::size_t, nodes_per_block> standing;  ///< the first component of each
  std::array<double, nodes_per_block> normal_N;
};

NodeUpdate::NodeUpdate(const ExplicitBody& body, const ExplicitChambers& chambers, const NodalLoads& loads,
                       const std::vector<double>& outer_areas_m2)
    : body_(body), chambers_(chambers), loads_(loads), areas_(outer_areas_m2) {
  for (const double mass : body.masses_kg()) {
    masses_.insert(masses_.end(), 3, mass);
    for (std::size_t i = 0; i < 3; ++i) weights_.push_back(mass * loads.gravity_m_per_s2[i]);
  }
}

NodesOutcome NodeUpdate::move(const SlotForces& forces, const StepTimes& times, FaceRange nodes,
                              std::span<double> displacements_m, std::span<double> velocities_m_per_s) const {
  const Kick kick = kick_of(times.kick_s, loads_.mass_damping_per_s);
  NodesOutcome outcome;
  Block block;
  for (std::size_t begin = nodes.begin; begin < nodes.end; begin += nodes_per_block) {
    block.first = 3 * begin;
    block.count = 3 * (std::min(begin + nodes_per_block, nodes.end) - begin);
    sum_forces(forces, displacements_m, block);
    double* v = velocities_m_per_s.data() + block.first;
    const double* inverse_masses = body_.inverse_masses_per_kg().data() + block.first;
    for (std::size_t n = 0; n < block.count; ++n)
      block.after_m_per_s[n] = kick.kept * v[n] + kick.time_s * inverse_masses[n] * block.load_N[n];
    MotionWork work;
    for (std::size_t s = 0; s < block.standing_count; ++s) {
      const std::size_t n = block.standing[s];
      if (!(inverse_masses[n] > 0.0 && inverse_masses[n + 1] > 0.0)) continue;
      work.friction_J += apply_friction(loads_.ground->friction, kick, block.normal_N[s], masses_[block.first + n], v + n,
                                        block.after_m_per_s.data() + n);
    }
    for (std::size_t n = 0; n < block.count; ++n) block.mean_m_per_s[n] = 0.5 * (v[n] + block.after_m_per_s[n]);
    add_work(forces, times.kick_s, block, work);
    outcome.work += work;
    double* u = displacements_m.data() + block.first;
    for (std::size_t n = 0; n < block.count; ++n) {
      v[n] = block.after_m_per_s[n];
      u[n] += times.drift_s * block.after_m_per_s[n];
    }
    outcome.largest_speed_square_m2_per_s2 =
        std::max(outcome.largest_speed_square_m2_per_s2, largest_speed_square(v, block.count, times.common_velocity_m_per_s));
  }
  return outcome;
}

/// Sums all forces except friction on the ground.
void NodeUpdate::sum_forces(const SlotForces& forces, std::span<const double> displacements_m, Block& block) const {
  for (std::size_t n = 0; n < block.count; n += 3) {
    const std::size_t node = (block.first + n) / 3;
    const Point inner = sum_of(body_.boxes().slots(), forces.elements_N, node);
    const Point pressure = sum_of(chambers_.slots(), forces.chambers_N, node);
    for (std::size_t i = 0; i < 3; ++i) {
      block.pressure_N[n + i] = pressure[i];
      block.load_N[n + i] = pressure[i] - inner[i];
    }
  }
  const double* weights = weights_.data() + block.first;
  for (std::size_t n = 0; n < block.count; ++n) block.load_N[n] += weights[n];
  block.standing_count = 0;
  if (loads_.ground) {
    const RigidGround& ground = *loads_.ground;
    for (std::size_t n = 0; n < block.count; n += 3) {
      const std::size_t z = block.first + n + 2;
      const double depth = ground.height_m - (body_.reference_positions_m()[z] + displacements_m[z]);
      if (!(depth > 0.0)) continue;
      const double normal = ground.stiffness_Pa_per_m * areas_[z / 3] * depth;
      block.load_N[n + 2] += normal;
      block.normal_N[block.standing_count] = normal;
      block.standing[block.standing_count++] = n;
    }
  }
  for (const std::span<const double> more : {forces.self_contact_N, forces.self_friction_N})
    for (std::size_t n = 0; n < (more.empty() ? 0 : block.count); ++n) block.load_N[n] += more[block.first + n];
}

/// Adds the work of a kick. The work of pressure, weight, ground, contact, friction and mass damping is force times the mean of
/// both velocities, consistent with the change of kinetic energy. The work of the elements is not counted here: the energy
/// balance has their energy and their dissipation instead.
void NodeUpdate::add_work(const SlotForces& forces, double time_s, const Block& block, MotionWork& work) const {
  const double* mean = block.mean_m_per_s.data();
  const auto work_of = [&](const double* force) { return time_s * product_sum(force, mean, block.count); };
  work.pressure_J += work_of(block.pressure_N.data());
  work.gravity_J += work_of(weights_.data() + block.first);
  double contact_power = 0.0;
  for (std::size_t s = 0; s < block.standing_count; ++s) contact_power += block.normal_N[s] * mean[block.standing[s] + 2];
  work.contact_J += time_s * contact_power;
  if (!forces.self_contact_N.empty()) work.self_contact_J += work_of(forces.self_contact_N.data() + block.first);
  if (!forces.self_friction_N.empty()) work.friction_J -= work_of(forces.self_friction_N.data() + block.first);
  if (loads_.mass_damping_per_s == 0.0) return;
  std::array<double, 3 * nodes_per_block> momentum;
  for (std::size_t n = 0; n < block.count; ++n) momentum[n] = masses_[block.first + n] * mean[n];
  work.mass_damping_J += loads_.mass_damping_per_s * work_of(momentum.data());
}

}  // namespace menger::fem
