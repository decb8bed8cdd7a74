#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fem/contact/rigid_ground.h"
#include "fem/explicit/explicit_body.h"
#include "fem/explicit/explicit_chambers.h"
#include "fem/motion/motion_energy.h"

namespace menger::fem {

/// Gravity, mass damping and the ground. Forces of elements, chambers and self-contact come in with BodyForces.
struct NodalLoads {
  Point gravity_m_per_s2{};
  double mass_damping_per_s = 0.0;  ///< alpha >= 0: a force -alpha m v
  std::optional<RigidGround> ground{};
};

/// The forces of elements, those of chambers in their slots, and those of a body's contact with itself.
struct BodyForces {
  const ElementForces& elements;
  ElementForces* followers = nullptr;         ///< elements that follow the nodes (ElementForces::follow); nullptr: none
  std::span<const double> chamber_slots_N{};  ///< empty: the elements take the pressure
  std::span<const double> self_contact_N{};   ///< 3 per node; empty: none
  std::span<const double> self_friction_N{};  ///< 3 per node; empty: none
  /// Whether self-contact has forces on a node of each block of NodeUpdate::nodes_at_once nodes.
  std::span<const char> touched_blocks{};
};

/// The two parts of a step: the kick (forces change velocities) lasts the mean of the last step and this one, the drift
/// (velocities change displacements) lasts this step.
struct StepTimes {
  double kick_s = 0.0;
  double drift_s = 0.0;
  Point common_velocity_m_per_s{};  ///< speeds are relative to it
};

/// The work of a step and a bound of speeds.
struct NodesOutcome {
  MotionWork work;  ///< of the kick, without that of pressure and weight
  /// The square of a bound of the nodes' speeds after the kick, relative to the common velocity. The bound is at least the
  /// largest speed, and at most sqrt(3) times it.
  double speed_bound_square_m2_per_s2 = 0.0;
};

/// Sums the forces on nodes and moves each node independently of the others. Nodes that are held in x or y feel no friction.
class NodeUpdate {
 public:
  /// Keeps references.
  /// @param outer_areas_m2 one per node; used only if there is a ground
  NodeUpdate(const ExplicitBody& body, const ExplicitChambers& chambers, const NodalLoads& loads,
             const std::vector<double>& outer_areas_m2);

  /// Moves a range of nodes.
  /// @param nodes begins at a multiple of nodes_at_once
  /// @param displacements_m, velocities_m_per_s 3 per node, changed
  /// @param clearances_m block_count of them, changed: each block of nodes is at least so far above the ground, and is not
  /// looked at before it can have come down. To be set to 0 where nodes are moved in another way.
  NodesOutcome move(const BodyForces& forces, const StepTimes& times, IndexRange nodes, std::span<double> displacements_m,
                    std::span<double> velocities_m_per_s, std::span<double> clearances_m) const;

  static constexpr std::size_t nodes_at_once = 128;
  static constexpr std::size_t block_count(std::size_t node_count) { return (node_count + nodes_at_once - 1) / nodes_at_once; }

 private:
  struct Block;
  void sum_forces(const BodyForces& forces, Block& block) const;
  double push_from_ground(std::span<const double> displacements_m, Block& block) const;
  void add_work(const BodyForces& forces, double time_s, const double* before_m_per_s, const Block& block,
                MotionWork& work) const;

  const ExplicitBody& body_;
  const ExplicitChambers& chambers_;
  const NodalLoads& loads_;
  const std::vector<double>& areas_;
};

}  // namespace menger::fem
