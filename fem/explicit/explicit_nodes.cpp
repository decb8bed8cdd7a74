#include "fem/explicit/explicit_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "fem/explicit/wide_loops.h"

namespace menger::fem {
namespace {

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

// Loops over the components of a block. They give the same numbers for any width of registers: products are not contracted with
// sums, and each index modulo the number of lanes has its own sum.
constexpr std::size_t lanes = 8;

/// Arrays over the components of a block, none of which overlap.
struct BlockArrays {
  std::size_t count;
  const double* __restrict pressure_N;
  const double* __restrict weight_N;
  const double* __restrict inverse_masses_per_kg;
  double* __restrict velocities_m_per_s;
  double* __restrict displacements_m;
};

/// @param inner_N the elements' forces
MENGER_WIDE_LOOPS void kick_block(const BlockArrays& block, const Kick& kick, const double* __restrict inner_N,
                                  double* __restrict after_m_per_s) {
  const auto [count, pressure, weight, inverse_masses, velocities, displacements] = block;
  const auto [kept, share, time] = kick;
  for (std::size_t n = 0; n < count; ++n)
    after_m_per_s[n] = kept * velocities[n] + time * inverse_masses[n] * (pressure[n] - inner_N[n] + weight[n]);
}

/// Sets the mean of the velocities before and after, then moves on.
MENGER_WIDE_LOOPS void drift_block(const BlockArrays& block, double time_s, const double* __restrict after_m_per_s,
                                   double* __restrict mean_m_per_s) {
  const auto [count, pressure, weight, inverse_masses, velocities, displacements] = block;
  for (std::size_t n = 0; n < count; ++n) {
    const double after = after_m_per_s[n];
    mean_m_per_s[n] = 0.5 * (velocities[n] + after);
    velocities[n] = after;
    displacements[n] += time_s * after;
  }
}

MENGER_WIDE_LOOPS double product_sum(const double* a, const double* b, std::size_t count) {
  std::array<double, lanes> sums{};
  const std::size_t whole = count / lanes * lanes;
  for (std::size_t n = 0; n < whole; n += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += a[n + lane] * b[n + lane];
  for (std::size_t n = whole; n < count; ++n) sums[n - whole] += a[n] * b[n];
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// The square of a bound of the nodes' speeds: of a vector of the largest components.
MENGER_WIDE_LOOPS double speed_bound_square(const double* velocities, std::size_t count, const Point& common_velocity) {
  std::array<double, 3 * lanes> common{};
  std::array<double, 3 * lanes> largest{};
  for (std::size_t lane = 0; lane < 3 * lanes; ++lane) common[lane] = common_velocity[lane % 3];
  const std::size_t whole = count / (3 * lanes) * (3 * lanes);
  for (std::size_t n = 0; n < whole; n += 3 * lanes) {
    for (std::size_t lane = 0; lane < 3 * lanes; ++lane) {
      const double apart = std::abs(velocities[n + lane] - common[lane]);
      largest[lane] = apart > largest[lane] ? apart : largest[lane];
    }
  }
  for (std::size_t n = whole; n < count; ++n)
    largest[n - whole] = std::max(largest[n - whole], std::abs(velocities[n] - common[n - whole]));
  Point of_axis{};
  for (std::size_t lane = 0; lane < 3 * lanes; ++lane) of_axis[lane % 3] = std::max(of_axis[lane % 3], largest[lane]);
  return dot(of_axis, of_axis);
}

constexpr std::size_t nodes_at_once = 128;

}  // namespace

/// A block of nodes during a step; component i of its nth node at 3 n + i. Loops over whole arrays use vector registers, and give
/// the same numbers for any register width.
struct NodeUpdate::Block {
  std::size_t first = 0;  ///< first component in the body
  std::size_t count = 0;  ///< of components
  std::array<double, 3 * nodes_at_once> pressure_N;
  std::array<double, 3 * nodes_at_once> load_N;
  std::array<double, 3 * nodes_at_once> after_m_per_s;
  std::array<double, 3 * nodes_at_once> mean_m_per_s;
  std::size_t standing_count = 0;                   ///< number of nodes that the ground pushes
  std::array<std::size_t, nodes_at_once> standing;  ///< the first component of each
  std::array<double, nodes_at_once> normal_N;
};

NodeUpdate::NodeUpdate(const ExplicitBody& body, const ExplicitChambers& chambers, const NodalLoads& loads,
                       const std::vector<double>& outer_areas_m2)
    : body_(body), chambers_(chambers), loads_(loads), areas_(outer_areas_m2) {
  for (const double mass : body.masses_kg()) {
    masses_.insert(masses_.end(), 3, mass);
    for (std::size_t i = 0; i < 3; ++i) weights_.push_back(mass * loads.gravity_m_per_s2[i]);
  }
}

NodesOutcome NodeUpdate::move(const BodyForces& forces, const StepTimes& times, IndexRange nodes,
                              std::span<double> displacements_m, std::span<double> velocities_m_per_s) const {
  const Kick kick = kick_of(times.kick_s, loads_.mass_damping_per_s);
  NodesOutcome outcome;
  Block block;
  for (std::size_t begin = nodes.begin; begin < nodes.end; begin += nodes_at_once) {
    block.first = 3 * begin;
    block.count = 3 * (std::min(begin + nodes_at_once, nodes.end) - begin);
    double* v = velocities_m_per_s.data() + block.first;
    const double* inverse_masses = body_.inverse_masses_per_kg().data() + block.first;
    const BlockArrays arrays{block.count,
                             block.pressure_N.data(),
                             weights_.data() + block.first,
                             inverse_masses,
                             v,
                             displacements_m.data() + block.first};
    sum_forces(forces, block);
    kick_block(arrays, kick, block.load_N.data(), block.after_m_per_s.data());
    push_from_ground(displacements_m, block);
    for (std::size_t s = 0; s < block.standing_count; ++s) {
      const std::size_t z = block.standing[s] + 2;
      block.after_m_per_s[z] += kick.time_s * inverse_masses[z] * block.normal_N[s];
    }
    for (const std::span<const double> more : {forces.self_contact_N, forces.self_friction_N})
      for (std::size_t n = 0; n < (more.empty() ? 0 : block.count); ++n)
        block.after_m_per_s[n] += kick.time_s * inverse_masses[n] * more[block.first + n];
    MotionWork work;
    for (std::size_t s = 0; s < block.standing_count; ++s) {
      const std::size_t n = block.standing[s];
      if (!(inverse_masses[n] > 0.0 && inverse_masses[n + 1] > 0.0)) continue;
      work.friction_J += apply_friction(loads_.ground->friction, kick, block.normal_N[s], masses_[block.first + n], v + n,
                                        block.after_m_per_s.data() + n);
    }
    drift_block(arrays, times.drift_s, block.after_m_per_s.data(), block.mean_m_per_s.data());
    add_work(forces, times.kick_s, block, work);
    outcome.work += work;
    outcome.speed_bound_square_m2_per_s2 =
        std::max(outcome.speed_bound_square_m2_per_s2, speed_bound_square(v, block.count, times.common_velocity_m_per_s));
  }
  return outcome;
}

/// Sums the forces of elements and chambers.
void NodeUpdate::sum_forces(const BodyForces& forces, Block& block) const {
  const std::size_t first_node = block.first / 3;
  forces.elements.sum({first_node, first_node + block.count / 3}, block.load_N.data());
  for (std::size_t n = 0; n < block.count; n += 3) {
    const auto pressure = chambers_.slots().sum(forces.chamber_slots_N.data(), (block.first + n) / 3);
    for (std::size_t i = 0; i < 3; ++i) block.pressure_N[n + i] = pressure[i];
  }
}

/// Finds the nodes below the ground and the forces that push them up.
void NodeUpdate::push_from_ground(std::span<const double> displacements_m, Block& block) const {
  block.standing_count = 0;
  if (!loads_.ground) return;
  const RigidGround& ground = *loads_.ground;
  const double* positions = body_.reference_positions_m().data() + block.first;
  const double* displacements = displacements_m.data() + block.first;
  for (std::size_t n = 0; n < block.count; n += 3) {
    const double depth = ground.height_m - (positions[n + 2] + displacements[n + 2]);
    if (!(depth > 0.0)) continue;
    block.normal_N[block.standing_count] = ground.stiffness_Pa_per_m * areas_[(block.first + n) / 3] * depth;
    block.standing[block.standing_count++] = n;
  }
}

/// Adds the work of a kick. The work of pressure, weight, ground, contact, friction and mass damping is force times the mean of
/// both velocities, consistent with the change of kinetic energy. The work of the elements is not counted here: the energy
/// balance has their energy and their dissipation instead.
void NodeUpdate::add_work(const BodyForces& forces, double time_s, const Block& block, MotionWork& work) const {
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
  std::array<double, 3 * nodes_at_once> momentum;
  for (std::size_t n = 0; n < block.count; ++n) momentum[n] = masses_[block.first + n] * mean[n];
  work.mass_damping_J += loads_.mass_damping_per_s * work_of(momentum.data());
}

}  // namespace menger::fem
