#include <type_traits>

#include "io/device/cuda_block_thread.cuh"
#include "io/device/cuda_cluster_thread.cuh"
#include "io/device/device_memory.h"
#include "voxel/device/robot_kernels.h"
#include "voxel/device/robot_step.h"

namespace menger::voxel {

namespace {

// A thread has as many registers as the file has room for with so many threads: the law of a beam takes over a hundred.
constexpr int blocks_at_once = 2;

// Blocks that wait for each other came with compute capability 9.0. On older cards a robot is one block's.
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ < 900
using ThreadOfBlocks = io::CudaBlockThread;
#else
using ThreadOfBlocks = io::CudaClusterThread;
static_assert(most_blocks <= ThreadOfBlocks::most_blocks);
#endif

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

/// Steps robots whose poses, motions and loads lie in the memory of their block.
template <bool Velocity, BeamVariety Variety, class Real>
__device__ RobotOutcome step_in_block(const RobotData<Real>& robot, const BatchArrays<Real>& arrays, std::uint32_t count,
                                      Real* in_block) {
  __shared__ double memory[io::CudaBlockThread::memory_numbers];
  const std::size_t numbers = line_size * robot.stride;
  Real* const pose = arrays.state + robot.pose;
  Real* const motion = arrays.state + robot.motion;
  const SharedLines<Real> lines{in_block, in_block + numbers, in_block + 2 * numbers};
  copy_numbers(lines.pose, pose, numbers);
  copy_numbers(lines.motion, motion, numbers);
  __syncthreads();
  const io::CudaBlockThread thread(memory);
  const RobotOutcome outcome =
      RobotStepper<Velocity, Variety, false, Real, io::CudaBlockThread>(thread, robot, arrays, lines).advance(count);
  __syncthreads();
  copy_numbers(pose, lines.pose, numbers);
  copy_numbers(motion, lines.motion, numbers);
  return outcome;
}

/// Steps robots by several blocks each, which share the memory of the card.
template <bool Velocity, BeamVariety Variety, class Real>
__device__ RobotOutcome step_by_blocks(const RobotData<Real>& robot, const BatchArrays<Real>& arrays, std::uint32_t count) {
  __shared__ double memory[ThreadOfBlocks::memory_numbers];
  const SharedLines<Real> lines{arrays.state + robot.pose, arrays.state + robot.motion, arrays.loads + robot.loads};
  const ThreadOfBlocks thread(memory);
  return RobotStepper<Velocity, Variety, true, Real, ThreadOfBlocks>(thread, robot, arrays, lines).advance(count);
}

/// @param blocks of a robot
template <bool Velocity, BeamVariety Variety, bool InBlock, class Real>
__global__ void __launch_bounds__(most_block_threads, blocks_at_once)
    step_robots(const BatchArrays<Real> arrays, const std::uint32_t* robots, std::uint32_t blocks) {
  __shared__ __align__(16) unsigned char robot_memory[sizeof(RobotData<Real>)];
  extern __shared__ __align__(16) unsigned char lines_memory[];
  const std::uint32_t number = robots[blockIdx.x / blocks];
  const std::uint32_t count = arrays.steps[number];
  if (count == 0) return;
  auto* const robot = reinterpret_cast<RobotData<Real>*>(robot_memory);
  copy_for_block(robot, arrays.robots[number]);
  __syncthreads();
  RobotOutcome outcome;
  if constexpr (InBlock) {
    outcome = step_in_block<Velocity, Variety>(*robot, arrays, count, reinterpret_cast<Real*>(lines_memory));
  } else {
    outcome = step_by_blocks<Velocity, Variety>(*robot, arrays, count);
  }
  if (blockIdx.x % blocks == 0 && threadIdx.x == 0) arrays.outcomes[number] = outcome;
}

template <class Real>
using StepKernel = void (*)(BatchArrays<Real>, const std::uint32_t*, std::uint32_t);

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

/// Returns how many blocks may share a robot: the most wanted, or half of them, and so on, until the device has room for them
/// beside each other.
template <class Real>
std::uint32_t blocks_at_most(StepKernel<Real> kernel, std::uint32_t most, cudaLaunchConfig_t configuration) {
  int device = 0;
  io::check_cuda(cudaGetDevice(&device), "find the device");
  int has_clusters = 0;
  io::check_cuda(cudaDeviceGetAttribute(&has_clusters, cudaDevAttrClusterLaunch, device), "ask the device for clusters");
  if (has_clusters == 0) return 1;
  cudaLaunchAttribute cluster{};
  cluster.id = cudaLaunchAttributeClusterDimension;
  configuration.attrs = &cluster;
  configuration.numAttrs = 1;
  for (std::uint32_t blocks = most; blocks > 1; blocks /= 2) {
    cluster.val.clusterDim.x = blocks;
    cluster.val.clusterDim.y = cluster.val.clusterDim.z = 1;
    configuration.gridDim = dim3(blocks);
    int at_once = 0;
    io::check_cuda(cudaOccupancyMaxActiveClusters(&at_once, kernel, &configuration), "ask the device for clusters");
    if (at_once > 0) return blocks;
  }
  return 1;
}

}  // namespace

template <class Real>
void launch_steps(const LaunchShape& shape, const BatchArrays<Real>& arrays, const std::uint32_t* robots, std::size_t count,
                  cudaStream_t stream) {
  const StepKernel<Real> kernel = kernel_of(shape, Real());
  io::check_cuda(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(shape.block_bytes)),
                 "give a block the memory for a robot");
  cudaLaunchConfig_t configuration{};
  configuration.blockDim = dim3(shape.threads);
  configuration.dynamicSmemBytes = shape.block_bytes;
  configuration.stream = stream;
  std::uint32_t blocks = shape.blocks;
  cudaLaunchAttribute cluster{};
  if (blocks > 1) {
    io::check_cuda(cudaFuncSetAttribute(kernel, cudaFuncAttributeNonPortableClusterSizeAllowed, 1),
                   "allow clusters of many blocks");
    blocks = blocks_at_most(kernel, blocks, configuration);
    cluster.id = cudaLaunchAttributeClusterDimension;
    cluster.val.clusterDim.x = blocks;
    cluster.val.clusterDim.y = cluster.val.clusterDim.z = 1;
    configuration.attrs = &cluster;
    configuration.numAttrs = blocks > 1 ? 1 : 0;
  }
  configuration.gridDim = dim3(static_cast<unsigned>(count) * blocks);
  io::check_cuda(cudaLaunchKernelEx(&configuration, kernel, arrays, robots, blocks), "start the steps of robots");
}

template void launch_steps(const LaunchShape&, const BatchArrays<double>&, const std::uint32_t*, std::size_t, cudaStream_t);
template void launch_steps(const LaunchShape&, const BatchArrays<float>&, const std::uint32_t*, std::size_t, cudaStream_t);

}  // namespace menger::voxel
