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

/// The loads on nodes besides the forces of their elements and chambers.
struct NodalLoads {
  Point gravity_m_per_s2{};
  double mass_damping_per_s = 0.0;  ///< alpha >= 0: a force -alpha m v
  std::optional<RigidGround> ground{};
};

/// The forces of elements, those of chambers in their slots, and those of a body's contact with itself.
struct BodyForces {
  const ElementForces& elements;
  std::span<const double> chamber_slots_N;
  std::span<const double> self_contact_N{};   ///< 3 per node; empty: none
  std::span<const double> self_friction_N{};  ///< 3 per node; empty: none
};

/// The durations of the two halves of a step: the kick, over which forces change velocities, and the drift, over which velocities
/// change displacements.
struct StepTimes {
  double kick_s = 0.0;
  double drift_s = 0.0;
  Point common_velocity_m_per_s{};  ///< speeds are relative to it
};

/// The work of a step and a bound of speeds.
struct NodesOutcome {
  MotionWork work;  ///< of the kick
  /// The square of a speed that no node exceeds after the kick, relative to the common velocity; at most sqrt(3) times the
  /// largest.
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
  /// @param displacements_m, velocities_m_per_s 3 per node, changed
  NodesOutcome move(const BodyForces& forces, const StepTimes& times, IndexRange nodes, std::span<double> displacements_m,
                    std::span<double> velocities_m_per_s) const;

 private:
  struct Block;
  void sum_forces(const BodyForces& forces, Block& block) const;
  void push_from_ground(std::span<const double> displacements_m, Block& block) const;
  void add_work(const BodyForces& forces, double time_s, const Block& block, MotionWork& work) const;

  const ExplicitBody& body_;
  const ExplicitChambers& chambers_;
  const NodalLoads& loads_;
  const std::vector<double>& areas_;
  std::vector<double> masses_;   ///< per component
  std::vector<double> weights_;  ///< per component
};

}  // namespace menger::fem
