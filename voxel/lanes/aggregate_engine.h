#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "voxel/engine/engine.h"
#include "voxel/lanes/block_lanes.h"

namespace menger::voxel {

/// Whether an engine's body can be stepped in SIMD lanes as it is. That needs solid voxels without lateral coupling, no external
/// load, no energy balance, a sine as drive from the start on (or no drive), no term kept on request (KeptTerms), and no
/// divergence so far.
template <class Real>
[[nodiscard]] bool runs_in_lanes(const EngineOf<Real>& engine);

/// The engine of Simulation. It steps the blocks of an aggregate in SIMD lanes where that is faster, and any other body voxel by
/// voxel.
template <class Real>
class AggregateEngine final : public EngineOf<Real> {
 public:
  /// See the constructor of Simulation.
  AggregateEngine(const meshes::Polycube& body, double cell_edge_m, const Physics& physics, const VoxelLoads& loads,
                  const KernelOptions& options);

  [[nodiscard]] io::RunStatus advance(std::uint64_t steps, const std::atomic<bool>* stop) override;
  void set_threads(int threads) override;
  [[nodiscard]] std::vector<std::string> kernel_report() const override;

 private:
  [[nodiscard]] bool blocks_pay() const;
  void prepare_blocks();

  int threads_;
  std::string blocks_report_;                 ///< line of the kernel report about the blocks
  std::unique_ptr<BlockLanes<Real>> blocks_;  ///< null for a body that is stepped voxel by voxel
};

}  // namespace menger::voxel
