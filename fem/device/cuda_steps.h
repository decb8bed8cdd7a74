#pragma once

// Only where menger is built with CUDA.

#include <cstddef>
#include <cstdint>
#include <string>

#include "fem/device/body_arrays.h"
#include "fem/device/body_steps.h"
#include "fem/explicit/step_taker.h"
#include "io/device/device_memory.h"

namespace menger::fem {

/// Which arrays of a body lie in the fast memory of its block: always the rounded displacements, then as many as fit.
enum class BlockMemory { displacements, forces, motion };

/// What a block of threads is told about the steps of one body.
template <class Number>
struct alignas(16) CudaTask {
  bool ends = false;  ///< there is no more work: the block ends
  BlockMemory kept = BlockMemory::displacements;
  BodyView<Number> body;       ///< in the memory of the graphics processor
  StepsMemory<Number> memory;  ///< there, too
  detail::BlockOrder order;
  detail::BlockOutcome* outcome = nullptr;
  double* volumes_m3 = nullptr;  ///< see BodySteps::take
  // The same arrays in this processor's memory and in that of the graphics processor. Blocks copy them themselves.
  const uint4* host_arrays = nullptr;
  uint4* arrays = nullptr;
  std::size_t array_words = 0;  ///< 0: they are there already
  uint4* host_state = nullptr;
  uint4* state = nullptr;
  std::size_t given_words = 0;    ///< of the state, to be copied back: outcome, volumes, displacements, velocities, branches
  std::size_t words = 0;          ///< with pressures
  std::uint32_t* done = nullptr;  ///< in this processor's memory; becomes 1 at the end
};

/// Steps of one body on the graphics processor, by the blocks of CudaWorkers. Its state goes there and comes back with every
/// order.
template <class Number>
class CudaSteps final : public StepTaker {
 public:
  /// Steps in one order, at most.
  static constexpr std::size_t most_steps = 256;

  CudaSteps(const meshes::HexahedralMesh& mesh, const ExplicitBody& body, const ExplicitBodyOptions& options,
            const NodalLoads& loads);
  ~CudaSteps() override;

  [[nodiscard]] std::string text() const override;
  [[nodiscard]] StepsOutcome take(const StepsOrder& order, const SteppedBody& body) override;

 private:
  BodyArrays<Number> arrays_;
  std::size_t host_begin_ = 0, host_size_ = 0, device_begin_ = 0, device_size_ = 0;  ///< pieces of both memories
  std::byte* host_ = nullptr;                                                        ///< the state here
  CudaTask<Number> task_;
  std::size_t volumes_at_ = 0, displacements_at_ = 0, velocities_at_ = 0, branches_at_ = 0, pressures_at_ = 0;  ///< in the state
};

extern template class CudaSteps<float>;
extern template class CudaSteps<double>;

}  // namespace menger::fem
