#include "fem/explicit_nodes.h"

#include <algorithm>

namespace menger::fem {
namespace {

/// Forces of elements are further away than the nearest caches; those of nodes to come are asked for in time.
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

/// What a kick does to velocities: v1 = kept v0 + time f / m, with the time times 1 / (1 + a dt/2).
struct Kick {
  double kept;
  double share;  ///< 1 / (1 + a dt/2)
  double time_s;
};

/// Mass damping is taken at the mean of both velocities: (1 + a dt/2) v1 = (1 - a dt/2) v0 + dt f/m.
Kick kick_of(double time_s, double mass_damping_per_s) {
  const double damping = 0.5 * time_s * mass_damping_per_s;
  const double share = 1.0 / (1.0 + damping);
  return {(1.0 - damping) * share, share, time_s * share};
}

/// Friction acts last, on what all other forces would do. @param after changed @return what is lost, J
double apply_friction(const Friction& friction, const Kick& kick, double normal_N, double mass, const Point& before,
                      Point& after) {
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

}  // namespace

/// Work of pressure, weight, ground, contact, friction and mass damping is force times the mean of both velocities, as the change
/// of kinetic energy is. That of the elements is not counted here: the books have their energy and their dissipation instead.
NodesOutcome NodeUpdate::move(const SlotForces& forces, const StepTimes& times, FaceRange nodes,
                              std::span<double> displacements_m, std::span<double> velocities_m_per_s) const {
  const Kick kick = kick_of(times.kick_s, loads_.mass_damping_per_s);
  const Point gravity = loads_.gravity_m_per_s2;
  const RigidGround* ground = loads_.ground ? &*loads_.ground : nullptr;
  double pressure_power = 0.0;
  double contact_power = 0.0;
  double self_contact_power = 0.0;
  double self_friction_power = 0.0;
  double damped_power = 0.0;
  Point momentum{};
  NodesOutcome outcome;
  ExplicitWork& work = outcome.work;
  const bool has_self_contact = !forces.self_contact_N.empty();
  const bool has_self_friction = !forces.self_friction_N.empty();
  for (std::size_t node = nodes.begin; node < nodes.end; ++node) {
    double* u = displacements_m.data() + 3 * node;
    double* v = velocities_m_per_s.data() + 3 * node;
    const double mass = body_.masses_kg()[node];
    const double* inverse_masses = body_.inverse_masses_per_kg().data() + 3 * node;
    const Point inner = sum_of(body_.boxes().slots(), forces.elements_N, node);
    const Point pressure = sum_of(chambers_.slots(), forces.chambers_N, node);
    double normal = 0.0;
    if (ground != nullptr) {
      const double depth = ground->height_m - (body_.reference_positions_m()[3 * node + 2] + u[2]);
      normal = depth > 0.0 ? ground->stiffness_Pa_per_m * areas_[node] * depth : 0.0;
    }
    const Point before{v[0], v[1], v[2]};
    Point after{};
    for (std::size_t i = 0; i < 3; ++i) {
      double load = pressure[i] - inner[i] + mass * gravity[i] + (i == 2 ? normal : 0.0);
      if (has_self_contact) load += forces.self_contact_N[3 * node + i];
      if (has_self_friction) load += forces.self_friction_N[3 * node + i];
      after[i] = kick.kept * before[i] + kick.time_s * inverse_masses[i] * load;
    }
    if (normal > 0.0 && inverse_masses[0] > 0.0 && inverse_masses[1] > 0.0)
      work.friction_J += apply_friction(ground->friction, kick, normal, mass, before, after);
    const Point mean = scaled(0.5, sum(before, after));
    pressure_power += dot(pressure, mean);
    contact_power += normal * mean[2];
    if (has_self_contact)
      for (std::size_t i = 0; i < 3; ++i) self_contact_power += forces.self_contact_N[3 * node + i] * mean[i];
    if (has_self_friction)
      for (std::size_t i = 0; i < 3; ++i) self_friction_power += forces.self_friction_N[3 * node + i] * mean[i];
    damped_power += mass * dot(mean, mean);
    momentum = sum(momentum, scaled(mass, mean));
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] = after[i];
      u[i] += times.drift_s * after[i];
    }
    const Point apart = difference(after, times.common_velocity_m_per_s);
    outcome.largest_speed_square_m2_per_s2 = std::max(outcome.largest_speed_square_m2_per_s2, dot(apart, apart));
  }
  work.pressure_J = times.kick_s * pressure_power;
  work.contact_J = times.kick_s * contact_power;
  work.self_contact_J = times.kick_s * self_contact_power;
  work.friction_J -= times.kick_s * self_friction_power;
  work.gravity_J = times.kick_s * dot(gravity, momentum);
  work.mass_damping_J = times.kick_s * loads_.mass_damping_per_s * damped_power;
  return outcome;
}

}  // namespace menger::fem
