#pragma once

#include "evolution/evaluator.h"
#include "voxel/parameters.h"

namespace menger::evolution {

/// Judges bodies by how far they move on the voxel engine.
///
/// Of calibrated bodies it says where they left the range of validity. With OutsideRange::refuse a body that leaves it has
/// diverged, before the first step if its walls and its drive are enough to know.
class VoxelEvaluator final : public DesignEvaluator {
 public:
  /// @param cell_edge_m L > 0 @param duration_s simulated time of an evaluation, > 0 @param measure_from_s from when on
  /// displacement counts, 0 <= measure_from_s < duration_s: what a body gains while its drive begins is left out
  VoxelEvaluator(const voxel::Physics& physics, double cell_edge_m, double duration_s, double measure_from_s = 0.0);

  [[nodiscard]] Evaluation evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const override;
  [[nodiscard]] std::string physics() const override;

  /// Voxels of the body: every body takes the same time steps.
  [[nodiscard]] double cost(const meshes::Polycube& body, int level) const override;

 private:
  voxel::Physics physics_;
  double cell_edge_m_;
  double duration_s_;
  double measure_from_s_;
};

}  // namespace menger::evolution
