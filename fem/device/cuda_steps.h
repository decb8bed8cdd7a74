#pragma once

// Only where menger is built with CUDA.

#include <cstddef>
#include <string>

#include "fem/device/body_arrays.h"
#include "fem/device/body_steps.h"
#include "fem/explicit/step_taker.h"
#include "io/device/device_memory.h"

namespace menger::fem {

/// What a kernel is told about the steps of one body.
template <class Number>
struct CudaTask {
  BodyView<Number> body;
  StepsMemory<Number> memory;  ///< in the memory of the graphics processor
  detail::BlockOrder order;
  detail::BlockOutcome* outcome = nullptr;
  double* volumes_m3 = nullptr;  ///< see BodySteps::take
  /// The state in this processor's memory and in that of the graphics processor. Blocks copy it themselves: copies in queues
  /// would wait for the kernels of other bodies.
  uint4* host_state = nullptr;
  uint4* device_state = nullptr;
  std::size_t given_words = 0;  ///< from the first one: outcome, volumes, displacements, velocities, branches
  std::size_t words = 0;        ///< with pressures
};

/// Which arrays of a body lie in the fast memory of its block: always the rounded displacements, then as many as fit.
enum class BlockMemory { displacements, forces, motion };

/// Steps of one body on the graphics processor. Its state goes there and comes back with every order. Bodies whose takers are
/// called by different threads move at the same time.
template <class Number>
class CudaSteps final : public StepTaker {
 public:
  /// Threads of a block. More would have too few registers for the forces of an element.
  static constexpr int threads = sizeof(Number) == 4 ? 256 : 128;

  CudaSteps(const meshes::HexahedralMesh& mesh, const ExplicitBody& body, const ExplicitBodyOptions& options,
            const NodalLoads& loads);

  [[nodiscard]] std::string text() const override;
  [[nodiscard]] StepsOutcome take(const StepsOrder& order, const MovedBody& body) override;

 private:
  void take_room(std::size_t pressure_count);

  using Kernel = void (*)(CudaTask<Number>);
  BodyArrays<Number> arrays_;
  io::DeviceStream stream_;
  io::DeviceArray<std::byte> body_memory_;
  io::DeviceArray<std::byte> scratch_;
  io::DeviceArray<std::byte> state_;  ///< outcome, volumes, displacements, velocities, branches, pressures
  io::PinnedArray<std::byte> host_;   ///< the same here
  CudaTask<Number> task_;
  Kernel kernel_ = nullptr;
  std::size_t block_bytes_ = 0;
  std::size_t displacements_at_ = 0, velocities_at_ = 0, branches_at_ = 0, pressures_at_ = 0;  ///< in state_
};

extern template class CudaSteps<float>;
extern template class CudaSteps<double>;

}  // namespace menger::fem
