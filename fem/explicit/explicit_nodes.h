#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fem/contact/rigid_ground.h"
#include "fem/explicit/explicit_body.h"
#include "fem/explicit/explicit_chambers.h"
#include "fem/motion/explicit_energy.h"

namespace menger::fem {

/// What acts on nodes besides their elements and chambers.
struct NodalLoads {
  Point gravity_m_per_s2{};
  double mass_damping_per_s = 0.0;  ///< alpha >= 0: a force -alpha m v
  std::optional<RigidGround> ground{};
};

/// Forces of elements and chambers, in their slots, and of a body's contact with itself.
struct SlotForces {
  std::span<const double> elements_N;
  std::span<const double> chambers_N;
  std::span<const double> self_contact_N{};   ///< 3 per node; empty: none
  std::span<const double> self_friction_N{};  ///< 3 per node; empty: none
};

/// The two halves of a step: time over which forces change velocities, and time over which velocities change displacements.
struct StepTimes {
  double kick_s = 0.0;
  double drift_s = 0.0;
  Point common_velocity_m_per_s{};  ///< what speeds are told against
};

/// What came of a step.
struct NodesOutcome {
  ExplicitWork work;                            ///< of the kick
  double largest_speed_square_m2_per_s2 = 0.0;  ///< after the kick, against the common velocity
};

/// Sums the forces on nodes and moves them, each by itself. Nodes that are held in x or y feel no friction.
class NodeUpdate {
 public:
  /// Keeps references. @param outer_areas_m2 per node, read only where there is a ground
  NodeUpdate(const ExplicitBody& body, const ExplicitChambers& chambers, const NodalLoads& loads,
             const std::vector<double>& outer_areas_m2);

  /// Nodes begin to end. @param displacements_m, velocities_m_per_s 3 per node, changed
  NodesOutcome move(const SlotForces& forces, const StepTimes& times, FaceRange nodes, std::span<double> displacements_m,
                    std::span<double> velocities_m_per_s) const;

 private:
  struct Block;
  void sum_forces(const SlotForces& forces, std::span<const double> displacements_m, Block& block) const;
  void add_work(const SlotForces& forces, double time_s, const Block& block, ExplicitWork& work) const;

  const ExplicitBody& body_;
  const ExplicitChambers& chambers_;
  const NodalLoads& loads_;
  const std::vector<double>& areas_;
  std::vector<double> masses_;   ///< per component
  std::vector<double> weights_;  ///< per component
};

}  // namespace menger::fem
