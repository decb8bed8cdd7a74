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

/// Supports of a body other than its plates.
struct Supports {
  std::vector<std::size_t> fixed_voxels;  ///< these keep their position and orientation at rest
  bool ground = false;                    ///< frictionless, at z = 0, can only push
};

/// Rigid motion of a plate from rest: displacement of its centre, and rotation about its centre.
struct PlateMotion {
  Vector3<double> displacement{0.0, 0.0, 0.0};  ///< m
  Vector3<double> rotation{0.0, 0.0, 0.0};      ///< rotation vector, rad
};

/// A constant force and moment on a voxel (dead load).
struct PointLoad {
  std::size_t voxel = 0;
  Vector3<double> force{0.0, 0.0, 0.0};   ///< N
  Vector3<double> moment{0.0, 0.0, 0.0};  ///< N m
};

/// All loads on a body.
struct StaticLoads {
  std::vector<double> pressures_Pa;  ///< gauge, by chamber
  double gravity_m_s2 = 0.0;         ///< along -z
  std::vector<PlateMotion> plates;   ///< by plate of the body; empty: all plates at rest
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
/// The unknowns of every voxel that is not fixed are its displacement divided by the voxel edge L, and its world rotation vector.
/// Residuals are forces divided by A and moments divided by A L, where A is the largest axial stiffness EA of all wall classes.
/// All numbers are then of order one, and a symmetric matrix stays symmetric. Beams follow the law of the engine (beam.h) in the
/// small-angle or large-angle state that is given for each beam. Lateral coupling is that of LateralCoupling (see
/// coupling_springs).
class ForceBalance {
 public:
  /// @param body must outlive this object
  ForceBalance(const StaticBody& body, const Supports& supports);

  /// Sets the loads for all later calls. @return false if the laws give no usable size at the pressures, see driven_sizes
  [[nodiscard]] bool set_loads(const StaticLoads& loads);

  [[nodiscard]] StaticState state_at_rest() const;

  /// Moves the places on plates to where the loads put them.
  void place_plates(StaticState& state) const;

  /// Moves voxels by a step of the unknowns.
  void move(StaticState& state, const Eigen::VectorXd& step) const;

  /// Gives every beam the state that the engine would choose from its present one. @param only_to_large beams in the large-angle
  /// state keep it @return whether any beam changed
  [[nodiscard]] bool update_beam_states(StaticState& state, bool only_to_large) const;

  /// Loads on all nodes. The load on a place of a plate is the load of the body on the plate.
  [[nodiscard]] std::vector<NodeLoad> node_loads(const StaticState& state) const { return sum_loads(state, nullptr); }

  /// Force of the ground on a voxel, N, upwards: the sum over its feet, which turn with it (see FootContact).
  [[nodiscard]] double ground_force(const StaticState& state, std::size_t voxel) const;

  /// The scaled residual of the unknowns.
  [[nodiscard]] Eigen::VectorXd residual(const StaticState& state) const { return scaled(node_loads(state)); }

  /// Computes the scaled residual and writes minus its derivative into stiffness(). stiffness() has no values before.
  [[nodiscard]] Eigen::VectorXd linearise(const StaticState& state);
  [[nodiscard]] const Eigen::SparseMatrix<double>& stiffness() const { return stiffness_->matrix(); }

  /// Number of unknowns: six per voxel that is not fixed.
  [[nodiscard]] Eigen::Index unknown_count() const { return 6 * static_cast<Eigen::Index>(free_nodes_.size()); }

  /// Scaled lumped masses of the unknowns, s^2. The generalised eigenvalues of stiffness and masses are squares of angular
  /// frequencies.
  [[nodiscard]] Eigen::VectorXd masses() const;

  [[nodiscard]] const StaticBody& body() const { return *body_; }
  [[nodiscard]] const DrivenSizes& sizes() const { return sizes_; }
  [[nodiscard]] double rest_length(std::size_t beam) const { return rest_length_[beam]; }
  [[nodiscard]] double force_scale_N() const { return force_scale_; }
  /// Index of the first unknown of a node; nothing for a node that is fixed.
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
    Vector3<double> arm;  ///< from the centre of the voxel, m
    double stiffness;     ///< of the ground, N/m
    double push;          ///< of the ground, N, >= 0
  };
  [[nodiscard]] std::vector<PressedFoot> pressed_feet(const StaticState& state, std::size_t voxel) const;
  void add_weight_and_ground(const StaticState& state, std::vector<NodeLoad>& loads, BlockMatrix* stiffness) const;
  [[nodiscard]] Eigen::VectorXd scaled(const std::vector<NodeLoad>& loads) const;

  const StaticBody* body_;
  std::vector<std::vector<WallFoot>> feet_;  ///< by voxel; for a body on the ground
  double force_scale_;
  std::vector<std::optional<std::size_t>> free_;  ///< by node: its position among the voxels that are not fixed
  std::vector<std::size_t> free_nodes_;
  std::vector<std::array<std::size_t, 2>> coupled_;  ///< pairs of beams along different axes that meet at a voxel, once per voxel
  /// Made when it is first needed, because many balances only compute residuals.
  std::optional<BlockMatrix> stiffness_;
  std::vector<BlockPlaces> beam_places_;
  std::vector<BlockPlaces> coupled_places_;
  StaticLoads loads_;
  DrivenSizes sizes_;
  std::vector<double> rest_length_;
  std::vector<std::array<double, 2>> half_kink_;  ///< by beam, see StaticBody::half_kink
};

}  // namespace menger::voxel
