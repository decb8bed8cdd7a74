#include "fem/explicit/explicit_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "fem/explicit/node_kick.h"
#include "fem/explicit/wide_loops.h"

namespace menger::fem {
namespace {

// Loops over the components of a block. They give the same numbers for any width of registers: products are not contracted with
// sums, and each index modulo the number of lanes has its own sum.
constexpr std::size_t lanes = 8;

// Loops run over patterns of eight nodes.
constexpr std::size_t pattern = 3 * lanes;

/// A vector of every node of a pattern.
std::array<double, pattern> repeated(const Point& vector) {
  std::array<double, pattern> result;
  for (std::size_t n = 0; n < pattern; ++n) result[n] = vector[n % 3];
  return result;
}

/// Calls a function with each component of a block and its place in the pattern.
template <class Act>
[[gnu::always_inline]] inline void for_components(std::size_t count, const Act& act) {
  const std::size_t whole = count / pattern * pattern;
  for (std::size_t n = 0; n < whole; n += pattern)
    for (std::size_t place = 0; place < pattern; ++place) act(n + place, place);
  for (std::size_t n = whole; n < count; ++n) act(n, n - whole);
}

/// What kicks the components of a block.
struct Kicked {
  const double kept;
  const double time_s;
  const std::array<double, pattern> weight;

  Kicked(const Kick& kick, const Point& gravity)
      : kept(kick.kept), time_s(kick.time_s), weight(repeated(scaled(kick.time_s, gravity))) {}

  /// The velocity of a component after the kick. One that is held has an inverse mass of 0, and no weight.
  /// @param inner_N what resists: the elements' forces
  [[gnu::always_inline]] double velocity(std::size_t place, double before, double inverse_mass, double inner_N) const {
    return kept * before - time_s * inverse_mass * inner_N + (inverse_mass > 0.0 ? weight[place] : 0.0);
  }
};

/// What moves the components of a block on, with their largest speeds apart from a common velocity.
struct Drifted {
  const double time_s;
  const std::array<double, pattern> common;
  std::array<double, pattern> largest{};

  Drifted(double duration_s, const Point& common_velocity) : time_s(duration_s), common(repeated(common_velocity)) {}

  [[gnu::always_inline]] void move(std::size_t place, double after, double& velocity, double& displacement) {
    velocity = after;
    displacement += time_s * after;
    const double apart = std::abs(after - common[place]);
    largest[place] = apart > largest[place] ? apart : largest[place];
  }

  /// The square of a bound of the nodes' speeds: of a vector of the largest components.
  [[nodiscard]] double bound() const {
    Point of_axis{};
    for (std::size_t place = 0; place < pattern; ++place) of_axis[place % 3] = std::max(of_axis[place % 3], largest[place]);
    return dot(of_axis, of_axis);
  }
};

/// Writes the velocities after the kick.
MENGER_WIDE_LOOPS void kick_block(std::size_t count, const Kick& kick, const Point& gravity, const double* __restrict inner_N,
                                  const double* __restrict inverse_masses, const double* __restrict velocities,
                                  double* __restrict after) {
  const Kicked kicked(kick, gravity);
  for_components(count, [&](std::size_t n, std::size_t place) {
    after[n] = kicked.velocity(place, velocities[n], inverse_masses[n], inner_N[n]);
  });
}

/// Kicks and moves on nodes on which nothing else acts. @return as drift_block
MENGER_WIDE_LOOPS double kick_and_drift_block(std::size_t count, const Kick& kick, const Point& gravity, double time_s,
                                              const Point& common_velocity, const double* __restrict inner_N,
                                              const double* __restrict inverse_masses, double* __restrict velocities,
                                              double* __restrict displacements) {
  const Kicked kicked(kick, gravity);
  Drifted drifted(time_s, common_velocity);
  for_components(count, [&](std::size_t n, std::size_t place) {
    const double after = kicked.velocity(place, velocities[n], inverse_masses[n], inner_N[n]);
    drifted.move(place, after, velocities[n], displacements[n]);
  });
  return drifted.bound();
}

/// Moves on with the velocities after the kick. @return Drifted::bound
MENGER_WIDE_LOOPS double drift_block(std::size_t count, double time_s, const Point& common_velocity,
                                     const double* __restrict after, double* __restrict velocities,
                                     double* __restrict displacements) {
  Drifted drifted(time_s, common_velocity);
  for_components(count,
                 [&](std::size_t n, std::size_t place) { drifted.move(place, after[n], velocities[n], displacements[n]); });
  return drifted.bound();
}

MENGER_WIDE_LOOPS double product_sum(const double* a, const double* b, std::size_t count) {
  std::array<double, lanes> sums{};
  const std::size_t whole = count / lanes * lanes;
  for (std::size_t n = 0; n < whole; n += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += a[n + lane] * b[n + lane];
  for (std::size_t n = whole; n < count; ++n) sums[n - whole] += a[n] * b[n];
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// A clearance below this is measured again: rounding of many steps is far smaller.
constexpr double least_clearance_m = 1e-9;

}  // namespace

/// A block of nodes during a step; component i of its nth node at 3 n + i. Loops over whole arrays use vector registers, and give
/// the same numbers for any register width.
struct NodeUpdate::Block {
  std::size_t first = 0;    ///< first component in the body
  std::size_t count = 0;    ///< of components
  bool is_touched = false;  ///< whether self-contact has forces here
  std::array<double, 3 * nodes_at_once> load_N;
  std::array<double, 3 * nodes_at_once> after_m_per_s;
  std::size_t standing_count = 0;                     ///< number of nodes that the ground pushes
  std::array<std::size_t, nodes_at_once> standing{};  ///< the first component of each
  std::array<double, nodes_at_once> normal_N{};
};

NodeUpdate::NodeUpdate(const ExplicitBody& body, const ExplicitChambers& chambers, const NodalLoads& loads,
                       const std::vector<double>& outer_areas_m2)
    : body_(body), chambers_(chambers), loads_(loads), areas_(outer_areas_m2) {}

NodesOutcome NodeUpdate::move(const BodyForces& forces, const StepTimes& times, IndexRange nodes,
                              std::span<double> displacements_m, std::span<double> velocities_m_per_s,
                              std::span<double> clearances_m) const {
  const Kick kick = kick_of(times.kick_s, loads_.mass_damping_per_s);
  const double common_m_per_s = norm(times.common_velocity_m_per_s);
  NodesOutcome outcome;
  Block block;
  for (std::size_t begin = nodes.begin; begin < nodes.end; begin += nodes_at_once) {
    block.first = 3 * begin;
    block.count = 3 * (std::min(begin + nodes_at_once, nodes.end) - begin);
    double* v = velocities_m_per_s.data() + block.first;
    const double* inverse_masses = body_.inverse_masses_per_kg().data() + block.first;
    double* after = block.after_m_per_s.data();
    sum_forces(forces, block);
    double& clearance_m = clearances_m[begin / nodes_at_once];
    block.standing_count = 0;
    if (loads_.ground && clearance_m < least_clearance_m) clearance_m = push_from_ground(displacements_m, block);
    block.is_touched = !forces.self_contact_N.empty() && forces.touched_blocks[begin / nodes_at_once] != 0;
    const auto end_with = [&](double bound_square) {
      outcome.speed_bound_square_m2_per_s2 = std::max(outcome.speed_bound_square_m2_per_s2, bound_square);
      clearance_m -= times.drift_s * (std::sqrt(bound_square) + common_m_per_s);
      if (forces.followers != nullptr) forces.followers->follow({begin, begin + block.count / 3});
    };
    if (block.standing_count == 0 && !block.is_touched && loads_.mass_damping_per_s == 0.0) {
      end_with(kick_and_drift_block(block.count, kick, loads_.gravity_m_per_s2, times.drift_s, times.common_velocity_m_per_s,
                                    block.load_N.data(), inverse_masses, v, displacements_m.data() + block.first));
      continue;
    }
    kick_block(block.count, kick, loads_.gravity_m_per_s2, block.load_N.data(), inverse_masses, v, after);
    for (std::size_t s = 0; s < block.standing_count; ++s) {
      const std::size_t z = block.standing[s] + 2;
      after[z] += kick.time_s * inverse_masses[z] * block.normal_N[s];
    }
    if (block.is_touched) {
      for (const std::span<const double> more : {forces.self_contact_N, forces.self_friction_N})
        for (std::size_t n = 0; n < (more.empty() ? 0 : block.count); ++n)
          after[n] += kick.time_s * inverse_masses[n] * more[block.first + n];
    }
    MotionWork work;
    for (std::size_t s = 0; s < block.standing_count; ++s) {
      const std::size_t n = block.standing[s];
      if (!(inverse_masses[n] > 0.0 && inverse_masses[n + 1] > 0.0)) continue;
      const double mass = body_.masses_kg()[(block.first + n) / 3];
      work.friction_J += apply_friction(loads_.ground->friction, kick, block.normal_N[s], mass, v + n, after + n);
    }
    add_work(forces, times.kick_s, v, block, work);
    outcome.work += work;
    end_with(
        drift_block(block.count, times.drift_s, times.common_velocity_m_per_s, after, v, displacements_m.data() + block.first));
  }
  return outcome;
}

/// Sums the forces of elements and chambers.
void NodeUpdate::sum_forces(const BodyForces& forces, Block& block) const {
  const std::size_t first_node = block.first / 3;
  forces.elements.sum({first_node, first_node + block.count / 3}, block.load_N.data());
  if (forces.chamber_slots_N.empty()) return;
  for (std::size_t n = 0; n < block.count; n += 3) {
    const auto pressure = chambers_.slots().sum(forces.chamber_slots_N.data(), (block.first + n) / 3);
    for (std::size_t i = 0; i < 3; ++i) block.load_N[n + i] -= pressure[i];
  }
}

/// Finds the nodes below the ground and the forces that push them up.
/// @return the height of the lowest node of the block above the ground, m
double NodeUpdate::push_from_ground(std::span<const double> displacements_m, Block& block) const {
  const RigidGround& ground = *loads_.ground;
  const double* positions = body_.reference_positions_m().data() + block.first;
  const double* displacements = displacements_m.data() + block.first;
  double lowest_m = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < block.count; n += 3) {
    const double depth = ground.height_m - (positions[n + 2] + displacements[n + 2]);
    lowest_m = std::min(lowest_m, -depth);
    if (!(depth > 0.0)) continue;
    block.normal_N[block.standing_count] = ground.stiffness_Pa_per_m * areas_[(block.first + n) / 3] * depth;
    block.standing[block.standing_count++] = n;
  }
  return lowest_m;
}

/// Adds the work of a kick. The work of ground, contact, friction and mass damping is force times the mean of both velocities,
/// consistent with the change of kinetic energy. The work of elements, pressure and weight is not counted here: the energy
/// balance has their energies.
void NodeUpdate::add_work(const BodyForces& forces, double time_s, const double* before_m_per_s, const Block& block,
                          MotionWork& work) const {
  const auto mean = [&](std::size_t n) { return 0.5 * (before_m_per_s[n] + block.after_m_per_s[n]); };
  double contact_power = 0.0;
  for (std::size_t s = 0; s < block.standing_count; ++s) contact_power += block.normal_N[s] * mean(block.standing[s] + 2);
  work.contact_J += time_s * contact_power;
  if (!block.is_touched && loads_.mass_damping_per_s == 0.0) return;
  std::array<double, 3 * nodes_at_once> means;
  for (std::size_t n = 0; n < block.count; ++n) means[n] = mean(n);
  const auto work_of = [&](const double* force) { return time_s * product_sum(force, means.data(), block.count); };
  if (block.is_touched) work.self_contact_J += work_of(forces.self_contact_N.data() + block.first);
  if (block.is_touched && !forces.self_friction_N.empty())
    work.friction_J -= work_of(forces.self_friction_N.data() + block.first);
  if (loads_.mass_damping_per_s == 0.0) return;
  std::array<double, 3 * nodes_at_once> momentum;
  for (std::size_t n = 0; n < block.count; ++n) momentum[n] = body_.masses_kg()[(block.first + n) / 3] * means[n];
  work.mass_damping_J += loads_.mass_damping_per_s * work_of(momentum.data());
}

}  // namespace menger::fem
