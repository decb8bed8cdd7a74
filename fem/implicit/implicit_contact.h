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

/// Motion over a step: 3 numbers per local node.
struct StepMotion {
  std::span<const double> start_displacements_m;
  std::span<const double> displacements_m;
  std::span<const double> velocities_m_per_s;
  double velocity_by_displacement_per_s = 0.0;  ///< dv/du at the end of the step
};

/// Sums over the nodes of this rank.
struct GroundTotals {
  double force_N = 0.0;          ///< upwards on the body
  double normal_energy_J = 0.0;  ///< in the springs of the ground
  double stick_energy_J = 0.0;   ///< in the stick springs
  double friction_loss_J = 0.0;  ///< over the step, by the mean of the forces at its ends
};

/// A rigid ground under the nodes of a rank, by the model of explicit dynamics: each node of outer area A has a spring of A times
/// the ground's stiffness, and Coulomb's friction on its normal force N at the end of the step.
///
/// Without a regularisation speed friction is an elastic-plastic return map: a node that touches hangs on a stick spring, a given
/// part of its normal one, whose other end, the anchor, gives way where the force would exceed the friction that the node bears:
/// during a step the static coefficient times N where the node stuck before, the kinetic one where it slid or was in the air. A
/// node slides on as long as it moves along its pull, also where its spring loads again because N has grown; it sticks when it
/// stands still or turns back. So the force is continuous within a step, and falls to the kinetic one a step after a node broke
/// loose. Loaded nodes that stick have moved by force over spring and come back: what is to be seen of friction must be slower
/// or larger than mu N over the spring, mu times the depth at equal stiffness. With a regularisation speed friction is that of
/// rigid_ground.h, by velocity.
///
/// Nodes that are held in x or y feel no friction. Outer areas are int N_a dA over boundary faces that bound no chamber, in the
/// reference configuration: a quarter of each face at a node where elements are boxes of degree 1, as in explicit dynamics.
class ImplicitContact {
 public:
  /// Collective. @param stick_stiffness of the stick spring by that of the normal one, > 0
  ImplicitContact(const Assembly& assembly, const Body& body, const RigidGround& ground, double stick_stiffness);

  /// No node touches.
  [[nodiscard]] std::vector<GroundNode> free_nodes() const { return std::vector<GroundNode>(springs_.size()); }

  /// Subtracts the ground's forces from a residual. @param before, after nodes at the start and at the end of the step
  GroundTotals add_forces(const StepMotion& motion, std::span<const GroundNode> before, std::span<GroundNode> after,
                          std::span<double> residual_N) const;

  /// The same for a state that was reached before: friction as its nodes remember it.
  GroundTotals add_remembered_forces(std::span<const double> displacements_m, std::span<const GroundNode> nodes,
                                     std::span<double> residual_N) const;

  /// What a residual leaves of the forces in the plane on nodes that feel friction, added up without their directions, N.
  [[nodiscard]] double unbalanced_N(std::span<const GroundNode> nodes, std::span<const double> residual_N) const;

  /// Largest of the stick springs, N/m, the same on all ranks.
  [[nodiscard]] double largest_stick_stiffness_N_per_m() const { return largest_stick_stiffness_; }

  /// Adds the symmetric part of d(residual)/du to a matrix that has not been assembled since: without the change of friction with
  /// the normal force, which is not symmetric, and with the direction, where that decides about its coefficients.
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
