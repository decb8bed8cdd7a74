#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evolution/evaluation/evaluator.h"
#include "io/device/graphics_processor.h"
#include "meshes/load_cases/lean.h"
#include "voxel/lanes/simulation.h"
#include "voxel/model/parameters.h"

namespace menger::evolution {

/// Evaluates bodies by their displacement on the voxel engine. Several single modules are evaluated together in SIMD lanes, or
/// all bodies on a graphics processor.
///
/// voxel::lane_groups groups bodies of level 1. Aggregates are evaluated alone, since each fills registers by itself, and so are
/// bodies that do not run in lanes, such as calibrated ones. Every few tenths of a second, a large aggregate adapts its number of
/// threads to ThreadsNow.
///
/// For calibrated bodies the result has what left the range of validity. With OutsideRange::refuse a body outside the range gets
/// the status `diverged`, even before the first step if its walls and its drive show it.
class VoxelEvaluator final : public DesignEvaluator {
 public:
  /// @param cell_edge_m edge of a cell, > 0
  /// @param duration_s simulated time of an evaluation, > 0
  /// @param measure_from_s time from which displacement counts, 0 <= measure_from_s < duration_s; it leaves out the displacement
  /// while the drive begins
  /// @param last periods that are measured instead of the net displacement
  /// @param device that evaluates; see io::obstacle_to_device
  /// @param largest_lean_deg a body whose last periods are measured and that leans more (meshes::largest_lean) has `fell`, and no
  /// displacement: all of it is left out. 180: none has
  VoxelEvaluator(const voxel::Physics& physics, double cell_edge_m, double duration_s, double measure_from_s = 0.0,
                 std::optional<LastPeriods> last = {}, io::Device device = io::Device::cpu, double largest_lean_deg = 180.0);

  [[nodiscard]] Evaluation evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const override;
  [[nodiscard]] std::vector<Evaluation> evaluate_together(std::span<const EvaluationTask* const> tasks,
                                                          const std::atomic<bool>& stop,
                                                          const ThreadsNow& threads) const override;
  [[nodiscard]] std::vector<std::vector<std::size_t>> groups(std::span<const EvaluationTask> tasks, int workers) const override;
  [[nodiscard]] std::string physics() const override;
  /// Returns how many bodies the graphics processor has left to the processor.
  [[nodiscard]] std::string remark() const override;

  /// Returns the number of cells of the body: all bodies make the same time steps.
  [[nodiscard]] double cost(const meshes::Polycube& body, int level) const override;

 private:
  /// Bodies that are evaluated together.
  struct Walkers {
    std::vector<voxel::Simulation> simulations;
    std::vector<Evaluation*> results;  ///< per simulation
    std::vector<bool> on_processor;    ///< per simulation: the device left it to the processor
    std::vector<meshes::Lean> leans;   ///< per simulation, if falls are told
  };

  [[nodiscard]] bool tells_falls() const { return last_ && largest_lean_deg_ < 180.0; }
  [[nodiscard]] double voxel_edge_m() const;
  std::vector<io::RunStatus> advance(Walkers& walkers, double time_s, const std::atomic<bool>& stop,
                                     const ThreadsNow& threads) const;
  void walk_periods(Walkers& walkers, const std::atomic<bool>& stop, const ThreadsNow& threads) const;
  void walk(Walkers& walkers, const std::atomic<bool>& stop, const ThreadsNow& threads) const;

  voxel::Physics physics_;
  double cell_edge_m_;
  double duration_s_;
  double measure_from_s_;
  std::optional<LastPeriods> last_;
  io::Device device_;
  double largest_lean_deg_;
  mutable std::atomic<std::size_t> on_processor_{0};  ///< bodies that the device left to the processor
};

}  // namespace menger::evolution
