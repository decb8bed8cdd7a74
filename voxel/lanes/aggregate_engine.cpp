#include "voxel/lanes/aggregate_engine.h"

#include <optional>
#include <type_traits>
#include <utility>

#include "voxel/kernels/instruction_sets.h"
#include "voxel/lanes/blocks.h"
#include "voxel/lanes/lane_packing.h"

namespace menger::voxel {

namespace {

/// Writing a body's blocks into lanes and reading them out again costs about one step.
constexpr std::uint64_t fewest_steps_in_blocks = 16;

/// Largest body in double precision on one thread for which blocks in lanes are faster, measured with AVX-512. Larger bodies
/// mostly wait for memory.
constexpr std::size_t most_voxels_in_blocks = 10000;

}  // namespace

template <class Real>
bool runs_in_lanes(const EngineOf<Real>& engine) {
  return runs_in_lanes(engine.body().physics) && !engine.energy() && engine.options().kept_terms() == KeptTerms{} &&
         !engine.record().divergence && engine.moving_body().data().external_load == nullptr;
}

template <class Real>
AggregateEngine<Real>::AggregateEngine(const meshes::Polycube& body, double cell_edge_m, const Physics& physics,
                                       const VoxelLoads& loads, const KernelOptions& options)
    : EngineOf<Real>(body, cell_edge_m, physics, loads, options), threads_(options.threads) {
  prepare_blocks();
}

/// Whether blocks in lanes are faster than voxel by voxel with the present number of threads.
template <class Real>
bool AggregateEngine<Real>::blocks_pay() const {
  return std::is_same_v<Real, float> || threads_ > 1 || this->body().lattice.voxel_count() <= most_voxels_in_blocks;
}

/// Puts the blocks of an aggregate into lanes if that is faster.
template <class Real>
void AggregateEngine<Real>::prepare_blocks() {
  if (blocks_ || !this->options().blocks_in_lanes || !blocks_pay() || !runs_in_lanes<Real>(*this)) return;
  if (!this->moving_body().state().uniform()) return;
  std::optional<BlockBody> blocks = blocks_of(this->body().lattice);
  if (!blocks) return;
  const LaneKernels<Real>* kernels = kernels_for_blocks<Real>(this->instruction_set(), blocks->count);
  if (kernels == nullptr) return;
  blocks_report_ = "blocks of the aggregate in SIMD lanes: " + std::to_string(blocks->count) +
                   " blocks, lanes per register: " + std::to_string(kernels->lanes);
  blocks_ = std::make_unique<BlockLanes<Real>>(this->moving_body(), std::move(*blocks), *kernels, threads_);
}

template <class Real>
void AggregateEngine<Real>::set_threads(int threads) {
  threads_ = threads;
  prepare_blocks();
  if (blocks_) blocks_->set_threads(threads);
}

template <class Real>
io::RunStatus AggregateEngine<Real>::advance(std::uint64_t steps, const std::atomic<bool>* stop) {
  if (!blocks_ || !blocks_pay() || steps < fewest_steps_in_blocks) return EngineOf<Real>::advance(steps, stop);
  const RunRecord& record = this->record();
  if (record.divergence) return io::RunStatus::diverged;
  const std::uint64_t end = record.steps + steps;
  blocks_->advance(steps, stop);
  if (record.divergence) return io::RunStatus::diverged;
  return record.steps == end ? io::RunStatus::completed : io::RunStatus::stopped;
}

/// Blocks in lanes have only one kernel, which leaves no term out.
template <class Real>
std::vector<std::string> AggregateEngine<Real>::kernel_report() const {
  if (!blocks_) return EngineOf<Real>::kernel_report();
  std::vector<std::string> report = this->report_of_body();
  report.push_back(blocks_report_);
  return report;
}

template bool runs_in_lanes<double>(const EngineOf<double>&);
template bool runs_in_lanes<float>(const EngineOf<float>&);
template class AggregateEngine<double>;
template class AggregateEngine<float>;

}  // namespace menger::voxel
