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

/// The forces of elements and chambers, in their slots, and the forces of a body's contact with itself.
struct SlotForces {
  std::span<const double> elements_N;
  std::span<const double> chambers_N;
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

/// The work and the largest speed of a step.
struct NodesOutcome {
  MotionWork work;                              ///< of the kick
  double largest_speed_square_m2_per_s2 = 0.0;  ///< after the kick, relative to the common velocity
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
  NodesOutcome move(const SlotForces& forces, const StepTimes& times, FaceRange nodes, std::span<double> displacements_m,
                    std::span<double> velocities_m_per_s) const;

 private:
  struct Block;
  void sum_forces(const SlotForces& forces, std::span<const double> displacements_m, Block& block) const;
  void add_work(const SlotForces& forces, double time_s, const Block& block, MotionWork& work) const;

  const ExplicitBody& body_;
  const ExplicitChambers& chambers_;
  const NodalLoads& loads_;
  const std::vector<double>& areas_;
  std::vector<double> masses_;   ///< per component
  std::vector<double> weights_;  ///< per component
};

}  // namespace menger::fem
