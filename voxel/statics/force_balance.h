#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "voxel/model/wall_feet.h"
#include "voxel/statics/block_matrix.h"
#include "voxel/statics/static_body.h"

namespace menger::voxel {

/// What keeps a body in place, beside its plates.
struct Supports {
  std::vector<std::size_t> fixed_voxels;  ///< whose position and orientation stay as they are at rest
  bool ground = false;                    ///< frictionless, at z = 0, pushes only
};

/// Rigid motion of a plate from rest: its centre moves, and it turns about its centre.
struct PlateMotion {
  Vector3<double> displacement{0.0, 0.0, 0.0};  ///< m
  Vector3<double> rotation{0.0, 0.0, 0.0};      ///< rotation vector, rad
};

/// A dead load on a voxel.
struct PointLoad {
  std::size_t voxel = 0;
  Vector3<double> force{0.0, 0.0, 0.0};   ///< N
  Vector3<double> moment{0.0, 0.0, 0.0};  ///< N m
};

/// What a body bears.
struct StaticLoads {
  std::vector<double> pressures_Pa;  ///< gauge, by chamber
  double gravity_m_s2 = 0.0;         ///< along -z
  std::vector<PlateMotion> plates;   ///< by plate of the body; none: all at rest
  std::vector<PointLoad> points;
};

/// Positions of all nodes and the states of all beams.
struct StaticState {
  std::vector<Pose> poses;  ///< by node
  std::vector<char> small;  ///< by beam: 1 in the small-angle state
};

/// Force (N) and moment (N m) on a node.
using NodeLoad = Eigen::Matrix<double, 6, 1>;

/// Forces and moments on the voxels of a body, and their derivatives.
///
/// Unknowns are, for every voxel that is not fixed, the displacement by the voxel edge L and the world rotation vector. Residuals
/// are forces by A and moments by A L, with A the largest axial stiffness EA of any class: all numbers are of order one, and a
/// symmetric matrix stays symmetric. Beams follow the law of the engine (beam.h) in the small- or the large-angle state that is
/// given for each; lateral coupling is that of LateralCoupling (see coupling_springs).
class ForceBalance {
 public:
  /// @param body must outlive this
  ForceBalance(const StaticBody& body, const Supports& supports);

  /// Loads for the calls that follow. @return false where the pressures leave no body to speak of, see driven_sizes
  [[nodiscard]] bool set_loads(const StaticLoads& loads);

  [[nodiscard]] StaticState state_at_rest() const;

  /// Puts the places on plates where the loads have them.
  void place_plates(StaticState& state) const;

  /// Moves voxels by a step of the unknowns.
  void move(StaticState& state, const Eigen::VectorXd& step) const;

  /// Puts every beam into the state that the engine would choose, given the one it was in. @param only_to_large leave beams in
  /// the large-angle state @return whether any changed
  [[nodiscard]] bool update_beam_states(StaticState& state, bool only_to_large) const;

  /// Loads on all nodes; those on places on a plate are what the body does to the plate.
  [[nodiscard]] std::vector<NodeLoad> node_loads(const StaticState& state) const { return sum_loads(state, nullptr); }

  /// Force of the ground on a voxel, N, upwards: the sum over its feet, which turn with it (see FootContact).
  [[nodiscard]] double ground_force(const StaticState& state, std::size_t voxel) const;

  /// Scaled residual of the unknowns.
  [[nodiscard]] Eigen::VectorXd residual(const StaticState& state) const { return scaled(node_loads(state)); }

  /// Scaled residual; puts minus its derivative into stiffness(), which before has no values.
  [[nodiscard]] Eigen::VectorXd linearise(const StaticState& state);
  [[nodiscard]] const Eigen::SparseMatrix<double>& stiffness() const { return stiffness_->matrix(); }

  /// Six for every voxel that is not fixed.
  [[nodiscard]] Eigen::Index unknown_count() const { return 6 * static_cast<Eigen::Index>(free_nodes_.size()); }

  /// Scaled lumped masses of the unknowns, s^2: squares of angular frequencies are eigenvalues of the stiffness against them.
  [[nodiscard]] Eigen::VectorXd masses() const;

  [[nodiscard]] const StaticBody& body() const { return *body_; }
  [[nodiscard]] const DrivenSizes& sizes() const { return sizes_; }
  [[nodiscard]] double rest_length(std::size_t beam) const { return rest_length_[beam]; }
  [[nodiscard]] double force_scale_N() const { return force_scale_; }
  /// First unknown of a node, nothing for what is fixed.
  [[nodiscard]] std::optional<Eigen::Index> first_unknown(std::size_t node) const;

 private:
  using BlockPlaces = std::array<std::optional<BlockMatrix::Place>, 4>;  ///< lower-lower, lower-upper, upper-lower, upper-upper

  void lay_down_stiffness();
  [[nodiscard]] std::vector<std::array<std::size_t, 2>> pattern() const;
  [[nodiscard]] BlockPlaces places_of(std::size_t row_beam, std::size_t column_beam) const;
  [[nodiscard]] std::vector<NodeLoad> sum_loads(const StaticState& state, BlockMatrix* stiffness) const;
  void add_beam(const StaticState& state, std::size_t index, std::vector<NodeLoad>& loads, BlockMatrix* stiffness) const;
  void add_coupling(const StaticState& state, std::vector<NodeLoad>& loads, BlockMatrix* stiffness) const;
  struct PressedFoot {
    Vector3<double> arm;  ///< from the centre of its voxel, m
    double stiffness;     ///< of the ground, N/m
    double push;          ///< of the ground, N, >= 0
  };
  [[nodiscard]] std::vector<PressedFoot> pressed_feet(const StaticState& state, std::size_t voxel) const;
  void add_weight_and_ground(const StaticState& state, std::vector<NodeLoad>& loads, BlockMatrix* stiffness) const;
  [[nodiscard]] Eigen::VectorXd scaled(const std::vector<NodeLoad>& loads) const;

  const StaticBody* body_;
  std::vector<std::vector<WallFoot>> feet_;  ///< by voxel, of a body on the ground
  double force_scale_;
  std::vector<std::optional<std::size_t>> free_;  ///< by node: its position among the voxels that are not fixed
  std::vector<std::size_t> free_nodes_;
  std::vector<std::array<std::size_t, 2>> coupled_;  ///< pairs of beams along different axes at a voxel, once per voxel
  std::optional<BlockMatrix> stiffness_;  ///< laid down when it is first needed: many balances are only asked for residuals
  std::vector<BlockPlaces> beam_places_;
  std::vector<BlockPlaces> coupled_places_;
  StaticLoads loads_;
  DrivenSizes sizes_;
  std::vector<double> rest_length_;
};

}  // namespace menger::voxel
