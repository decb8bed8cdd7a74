#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "voxel/engine/engine.h"
#include "voxel/lanes/block_lanes.h"

namespace menger::voxel {

/// Whether a body can be stepped in SIMD lanes as it is: solid voxels without lateral coupling, without loads, with a drive that
/// is a sine, no term kept on request, not diverged.
template <class Real>
[[nodiscard]] bool runs_in_lanes(const EngineOf<Real>& engine);

/// The engine that moves an aggregate's blocks in SIMD lanes where that is faster than voxel by voxel, which it does with any
/// other body.
template <class Real>
class AggregateEngine final : public EngineOf<Real> {
 public:
  /// See Simulation.
  AggregateEngine(const meshes::Polycube& body, double cell_edge_m, const Physics& physics, const VoxelLoads& loads,
                  const KernelOptions& options);

  [[nodiscard]] io::RunStatus advance(std::uint64_t steps, const std::atomic<bool>* stop) override;
  void set_threads(int threads) override;
  [[nodiscard]] std::vector<std::string> kernel_report() const override;

 private:
  [[nodiscard]] bool blocks_pay() const;
  void prepare_blocks();

  int threads_;
  std::string blocks_report_;                 ///< of the blocks
  std::unique_ptr<BlockLanes<Real>> blocks_;  ///< of a body whose blocks go in lanes
};

}  // namespace menger::voxel
