#include <type_traits>

#include "io/device/cuda_block_thread.cuh"
#include "io/device/device_memory.h"
#include "voxel/device/robot_kernels.h"
#include "voxel/device/robot_step.h"

namespace menger::voxel {

namespace {

// A thread has as many registers as the file has room for with so many threads: the law of a beam takes over a hundred.
constexpr int block_threads = 256;
constexpr int blocks_at_once = 2;
constexpr int large_block_threads = most_block_threads;

/// Copies an object for all threads of a block.
template <class Object>
__device__ void copy_for_block(Object* to, const Object& from) {
  static_assert(sizeof(Object) % sizeof(std::uint32_t) == 0);
  for (std::size_t i = threadIdx.x; i < sizeof(Object) / sizeof(std::uint32_t); i += blockDim.x)
    reinterpret_cast<std::uint32_t*>(to)[i] = reinterpret_cast<const std::uint32_t*>(&from)[i];
}

template <class Real>
__device__ void copy_numbers(Real* to, const Real* from, std::size_t count) {
  for (std::size_t i = threadIdx.x; i < count; i += blockDim.x) to[i] = from[i];
}

template <bool Velocity, BeamVariety Variety, bool InBlock, class Real>
__global__ void __launch_bounds__(InBlock ? block_threads : large_block_threads, InBlock ? blocks_at_once : 1)
    step_robots(const BatchArrays<Real> arrays, const std::uint32_t* robots) {
  __shared__ double memory[io::CudaBlockThread::memory_numbers];
  __shared__ __align__(16) unsigned char robot_memory[sizeof(RobotData<Real>)];
  extern __shared__ __align__(16) unsigned char lines_memory[];
  const std::uint32_t number = robots[blockIdx.x];
  const std::uint32_t count = arrays.steps[number];
  if (count == 0) return;
  auto* const copy = reinterpret_cast<RobotData<Real>*>(robot_memory);
  copy_for_block(copy, arrays.robots[number]);
  __syncthreads();
  const RobotData<Real>& robot = *copy;
  const std::size_t numbers = line_size * robot.stride;
  Real* const pose = arrays.state + robot.pose;
  Real* const motion = arrays.state + robot.motion;
  const io::CudaBlockThread thread(memory);
  RobotOutcome outcome;
  if constexpr (InBlock) {
    Real* const in_block = reinterpret_cast<Real*>(lines_memory);
    const SharedLines<Real> lines{in_block, in_block + numbers, in_block + 2 * numbers};
    copy_numbers(lines.pose, pose, numbers);
    copy_numbers(lines.motion, motion, numbers);
    __syncthreads();
    outcome = RobotStepper<Velocity, Variety, Real, io::CudaBlockThread>(thread, robot, arrays, lines).advance(count);
    __syncthreads();
    copy_numbers(pose, lines.pose, numbers);
    copy_numbers(motion, lines.motion, numbers);
  } else {
    const SharedLines<Real> lines{pose, motion, arrays.loads + robot.loads};
    outcome = RobotStepper<Velocity, Variety, Real, io::CudaBlockThread>(thread, robot, arrays, lines).advance(count);
  }
  if (threadIdx.x == 0) arrays.outcomes[number] = outcome;
}

template <class Real>
using StepKernel = void (*)(BatchArrays<Real>, const std::uint32_t*);

template <bool Velocity, class Real>
StepKernel<Real> kernel_for(const LaunchShape& shape) {
  const auto of = [&]<BeamVariety Variety>(std::integral_constant<BeamVariety, Variety>) -> StepKernel<Real> {
    return shape.in_block ? step_robots<Velocity, Variety, true, Real> : step_robots<Velocity, Variety, false, Real>;
  };
  switch (shape.variety) {
    case BeamVariety::uniform:
      return of(std::integral_constant<BeamVariety, BeamVariety::uniform>{});
    case BeamVariety::classes:
      return of(std::integral_constant<BeamVariety, BeamVariety::classes>{});
    default:
      return of(std::integral_constant<BeamVariety, BeamVariety::own_lengths>{});
  }
}

StepKernel<double> kernel_of(const LaunchShape& shape, double) {
  return shape.velocity ? kernel_for<true, double>(shape) : kernel_for<false, double>(shape);
}
StepKernel<float> kernel_of(const LaunchShape& shape, float) { return kernel_for<true, float>(shape); }

}  // namespace

template <class Real>
void launch_steps(const LaunchShape& shape, const BatchArrays<Real>& arrays, const std::uint32_t* robots, std::size_t count,
                  cudaStream_t stream) {
  const StepKernel<Real> kernel = kernel_of(shape, Real());
  io::check_cuda(cudaFuncSetAttribute(reinterpret_cast<const void*>(kernel), cudaFuncAttributeMaxDynamicSharedMemorySize,
                                      static_cast<int>(shape.block_bytes)),
                 "give a block the memory for a robot");
  kernel<<<static_cast<unsigned>(count), shape.threads, shape.block_bytes, stream>>>(arrays, robots);
  io::check_cuda(cudaGetLastError(), "start the steps of robots");
}

template void launch_steps(const LaunchShape&, const BatchArrays<double>&, const std::uint32_t*, std::size_t, cudaStream_t);
template void launch_steps(const LaunchShape&, const BatchArrays<float>&, const std::uint32_t*, std::size_t, cudaStream_t);

}  // namespace menger::voxel
