#pragma once

#include <span>
#include <string>
#include <vector>

#include "evolution/evaluation/evaluator.h"
#include "voxel/lanes/simulation.h"
#include "voxel/model/parameters.h"

namespace menger::evolution {

/// Judges bodies by how far they move on the voxel engine; single modules in SIMD lanes, several at a time.
///
/// Together go bodies of level 1, as voxel::lane_groups finds them: aggregates fill registers by themselves, and what does not
/// run in lanes, such as a calibrated body, is judged alone. A large aggregate takes on threads that have run out of work, and
/// hands them back, every few tenths of a second.
///
/// Of calibrated bodies it says where they left the range of validity. With OutsideRange::refuse a body that leaves it has
/// diverged, before the first step if its walls and its drive are enough to know.
class VoxelEvaluator final : public DesignEvaluator {
 public:
  /// @param cell_edge_m L > 0 @param duration_s simulated time of an evaluation, > 0 @param measure_from_s from when on
  /// displacement counts, 0 <= measure_from_s < duration_s: what a body gains while its drive begins is left out
  VoxelEvaluator(const voxel::Physics& physics, double cell_edge_m, double duration_s, double measure_from_s = 0.0);

  [[nodiscard]] Evaluation evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const override;
  [[nodiscard]] std::vector<Evaluation> evaluate_together(std::span<const EvaluationTask* const> tasks,
                                                          const std::atomic<bool>& stop,
                                                          const ThreadsNow& threads) const override;
  [[nodiscard]] std::vector<std::vector<std::size_t>> groups(std::span<const EvaluationTask> tasks, int workers) const override;
  [[nodiscard]] std::string physics() const override;

  /// Voxels of the body: every body takes the same time steps.
  [[nodiscard]] double cost(const meshes::Polycube& body, int level) const override;

 private:
  void walk(std::span<voxel::Simulation> simulations, std::span<Evaluation* const> results, const std::atomic<bool>& stop,
            const ThreadsNow& threads) const;

  voxel::Physics physics_;
  double cell_edge_m_;
  double duration_s_;
  double measure_from_s_;
};

}  // namespace menger::evolution
