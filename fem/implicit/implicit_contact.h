#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fem/contact/rigid_ground.h"
#include "fem/motion/implicit_state.h"
#include "fem/statics/assembly.h"
#include "fem/statics/body.h"

namespace menger::fem {

/// The motion of the nodes over a step: 3 numbers per local node.
struct StepMotion {
  std::span<const double> start_displacements_m;
  std::span<const double> displacements_m;
  std::span<const double> velocities_m_per_s;
  double velocity_by_displacement_per_s = 0.0;  ///< dv/du at the end of the step
};

/// Totals of the ground contact over the nodes of this rank.
struct GroundTotals {
  double force_N = 0.0;          ///< upwards on the body
  double normal_energy_J = 0.0;  ///< in the springs of the ground
  double stick_energy_J = 0.0;   ///< in the stick springs
  double friction_loss_J = 0.0;  ///< over the step, by the mean of the forces at its ends
};

/// The contact of the nodes of a rank with a rigid ground, for implicit dynamics.
///
/// The ground acts on each node of outer area A through a normal spring of A times the ground's stiffness, as in explicit
/// dynamics. Coulomb friction uses the normal force N at the end of the step.
///
/// Without a regularisation speed, friction is an elastic-plastic return map. A node in contact is attached to a stick spring,
/// whose stiffness is a given multiple of that of the normal spring. The other end of the stick spring is the anchor. The anchor
/// moves where the spring force would exceed the friction limit of the node. During a step this limit is the static coefficient
/// times N for a node that stuck before, and the kinetic coefficient times N for a node that slid or was in the air. A sliding
/// node continues to slide as long as it moves along the pull of its spring, even where the spring loads again because N has
/// grown. It sticks when it stands still or turns back. So the friction force is continuous within a step, and falls to the
/// kinetic limit one step after a node has broken loose. A sticking node under load is displaced by force over spring stiffness,
/// and returns when the load ends. So only motion that is slower than this, or larger than mu N over the stick stiffness, shows
/// friction correctly; at equal stiffnesses that is mu times the depth.
///
/// With a regularisation speed, friction depends on the velocity as in rigid_ground.h.
///
/// Nodes that are held in x or y feel no friction. The outer area of a node is int N_a dA over the boundary faces that bound no
/// chamber, in the reference configuration. For boxes of degree 1 that is a quarter of each face at the node, as in explicit
/// dynamics.
class ImplicitContact {
 public:
  /// Finds the outer areas of the nodes. Collective.
  /// @param stick_stiffness stiffness of the stick spring over that of the normal spring, > 0
  ImplicitContact(const Assembly& assembly, const Body& body, const RigidGround& ground, double stick_stiffness);

  /// Returns the state in which no node touches the ground.
  [[nodiscard]] std::vector<GroundNode> free_nodes() const { return std::vector<GroundNode>(springs_.size()); }

  /// Subtracts the ground's forces from a residual and returns their totals.
  /// @param before, after nodes at the start and at the end of the step; `after` is written
  GroundTotals add_forces(const StepMotion& motion, std::span<const GroundNode> before, std::span<GroundNode> after,
                          std::span<double> residual_N) const;

  /// Does the same for a state that was reached before, with the friction forces that its nodes hold.
  GroundTotals add_remembered_forces(std::span<const double> displacements_m, std::span<const GroundNode> nodes,
                                     std::span<double> residual_N) const;

  /// Returns the sum of the sizes of the in-plane residual forces, N, over the nodes that touch the ground and feel friction.
  [[nodiscard]] double unbalanced_N(std::span<const GroundNode> nodes, std::span<const double> residual_N) const;

  /// Returns the largest stiffness of a stick spring, N/m, the same on all ranks.
  [[nodiscard]] double largest_stick_stiffness_N_per_m() const { return largest_stick_stiffness_; }

  /// Adds the symmetric part of d(residual)/du to a matrix with the nonzeros of the stiffness, which the caller assembles
  /// (MatAssemblyEnd) afterwards. Two terms are left out: the change of friction with the normal force, which is not symmetric,
  /// and its change with the direction of sliding where the coefficients depend on that direction.
  void add_matrix(const StepMotion& motion, std::span<const GroundNode> before, Mat matrix) const;

 private:
  struct Spring {
    Index node;
    double stiffness_N_per_m;
    bool has_friction;
  };
  struct Response {
    double normal_N = 0.0;
    GroundNode node;
    std::array<double, 4> tangent{};  ///< minus d(friction)/d(displacement in the plane), N/m
  };
  [[nodiscard]] Response response_of(const Spring& spring, const StepMotion& motion, const GroundNode& before) const;
  void stick_or_slip(const Spring& spring, const StepMotion& motion, const GroundNode& before, Response& response) const;
  void follow_speed(const std::array<double, 2>& velocity, double velocity_by_displacement, Response& response) const;
  void push(const Spring& spring, double normal_N, const GroundNode& node, std::span<double> residual_N,
            GroundTotals& totals) const;
  [[nodiscard]] double loss_of(const Spring& spring, const StepMotion& motion, const GroundNode& before,
                               const GroundNode& after) const;

  const Assembly& assembly_;
  RigidGround ground_;
  double stick_stiffness_;
  double largest_stick_stiffness_ = 0.0;
  std::vector<Spring> springs_;
};

}  // namespace menger::fem
