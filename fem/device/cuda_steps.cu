#include <cstring>
#include <mutex>
#include <variant>

#include "fem/device/cuda_steps.h"
#include "fem/device/warp_number.cuh"
#include "io/device/cuda_block_thread.cuh"

namespace menger::fem {
namespace {

using detail::WarpNumber;

/// Where arrays begin in the memory of a block, bytes.
struct BlockPlaces {
  std::size_t forces = 0, displacements = 0, velocities = 0, end = 0;
};

constexpr std::size_t for_sums = sizeof(double) * io::CudaBlockThread::memory_numbers;

__host__ __device__ constexpr std::size_t aligned(std::size_t bytes) { return (bytes + 15) / 16 * 16; }

template <class Number>
__host__ __device__ BlockPlaces places_of(const BodyView<Number>& body, BlockMemory kept) {
  BlockPlaces places;
  std::size_t end = for_sums + aligned(sizeof(Number) * (3 * body.node_count + 1));
  places.forces = end;
  if (kept != BlockMemory::displacements) end += aligned(sizeof(Number) * body.force_number_count);
  places.displacements = end;
  if (kept == BlockMemory::motion) end += sizeof(double) * 3 * body.node_count;
  places.velocities = end;
  if (kept == BlockMemory::motion) end += sizeof(double) * 3 * body.node_count;
  places.end = aligned(end);
  return places;
}

/// Copies words by all threads of a block, several at once: memory of the other processor answers late.
__device__ void copy_words(const uint4* from, std::size_t count, uint4* to) {
  constexpr std::size_t at_once = 8;
  for (std::size_t first = threadIdx.x; first < count; first += at_once * blockDim.x) {
    uint4 words[at_once];
#pragma unroll
    for (std::size_t n = 0; n < at_once; ++n)
      if (first + n * blockDim.x < count) words[n] = from[first + n * blockDim.x];
#pragma unroll
    for (std::size_t n = 0; n < at_once; ++n)
      if (first + n * blockDim.x < count) to[first + n * blockDim.x] = words[n];
  }
}

template <class Law, class Number, BlockMemory kept>
__global__ __launch_bounds__(CudaSteps<Number>::threads) void take_steps(const __grid_constant__ CudaTask<Number> task) {
  extern __shared__ double2 block_memory[];
  auto* const bytes = reinterpret_cast<std::byte*>(block_memory);
  const BlockPlaces places = places_of(task.body, kept);
  copy_words(task.host_state, task.words, task.device_state);
  __syncthreads();
  StepsMemory<Number> memory = task.memory;
  memory.values_m = reinterpret_cast<Number*>(bytes + for_sums);
  if constexpr (kept != BlockMemory::displacements) memory.forces_N = reinterpret_cast<Number*>(bytes + places.forces);
  const std::size_t count = 3 * task.body.node_count;
  if constexpr (kept == BlockMemory::motion) {
    memory.displacements_m = reinterpret_cast<double*>(bytes + places.displacements);
    memory.velocities_m_per_s = reinterpret_cast<double*>(bytes + places.velocities);
    for (std::size_t n = threadIdx.x; n < count; n += blockDim.x) {
      memory.displacements_m[n] = task.memory.displacements_m[n];
      memory.velocities_m_per_s[n] = task.memory.velocities_m_per_s[n];
    }
  }
  io::CudaBlockThread thread(reinterpret_cast<double*>(bytes));
  thread.wait();
  detail::BodySteps<Law, WarpNumber<Number>, io::CudaBlockThread> steps(thread, task.body, memory, task.order);
  const detail::BlockOutcome outcome = steps.take(task.volumes_m3);
  if (thread.index() == 0) *task.outcome = outcome;
  if constexpr (kept == BlockMemory::motion) {
    for (std::size_t n = threadIdx.x; n < count; n += blockDim.x) {
      task.memory.displacements_m[n] = memory.displacements_m[n];
      task.memory.velocities_m_per_s[n] = memory.velocities_m_per_s[n];
    }
  }
  __syncthreads();
  copy_words(task.device_state, task.given_words, task.host_state);
}

template <class Number>
using Kernel = void (*)(CudaTask<Number>);

template <class Number, BlockMemory kept, class... Laws>
Kernel<Number> kernel_of(std::size_t law, const std::variant<Laws...>*) {
  static constexpr Kernel<Number> kernels[] = {take_steps<Laws, Number, kept>...};
  return kernels[law];
}

template <class Number>
Kernel<Number> kernel_of(std::size_t law, BlockMemory kept) {
  const materials::HyperelasticLaw* laws = nullptr;
  if (kept == BlockMemory::motion) return kernel_of<Number, BlockMemory::motion>(law, laws);
  if (kept == BlockMemory::forces) return kernel_of<Number, BlockMemory::forces>(law, laws);
  return kernel_of<Number, BlockMemory::displacements>(law, laws);
}

std::size_t largest_block_bytes() {
  static const std::size_t bytes = [] {
    // Threads that wait for the device leave the processor to others: there are more of them than cores.
    io::check_cuda(cudaSetDeviceFlags(cudaDeviceScheduleBlockingSync), "wait without a processor");
    int largest = 0;
    io::check_cuda(cudaDeviceGetAttribute(&largest, cudaDevAttrMaxSharedMemoryPerBlockOptin, 0), "ask for the memory of a block");
    return static_cast<std::size_t>(largest);
  }();
  return bytes;
}

constexpr std::size_t alignment = 64;

/// Bytes that arrays take one after the other.
class Room {
 public:
  template <class Entry>
  std::size_t add(std::size_t count) {
    const std::size_t begin = (size_ + alignment - 1) / alignment * alignment;
    size_ = begin + count * sizeof(Entry);
    return begin;
  }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  std::size_t size_ = 0;
};

}  // namespace

template <class Number>
CudaSteps<Number>::CudaSteps(const meshes::HexahedralMesh& mesh, const ExplicitBody& body, const ExplicitBodyOptions& options,
                             const NodalLoads& loads)
    : arrays_(mesh, body, options, loads, 32) {
  const std::size_t largest = largest_block_bytes();
  body_memory_ = io::DeviceArray<std::byte>(arrays_.bytes().size());
  task_.body = arrays_.place(body_memory_.get());
  body_memory_.put(arrays_.bytes(), stream_);
  stream_.wait();
  const BodyView<Number>& view = task_.body;
  BlockMemory kept = BlockMemory::motion;
  while (kept != BlockMemory::displacements && places_of(view, kept).end > largest)
    kept = static_cast<BlockMemory>(static_cast<int>(kept) - 1);
  block_bytes_ = places_of(view, kept).end;
  kernel_ = kernel_of<Number>(arrays_.law(), kept);
  io::check_cuda(cudaFuncSetAttribute(reinterpret_cast<const void*>(kernel_), cudaFuncAttributeMaxDynamicSharedMemorySize,
                                      static_cast<int>(block_bytes_)),
                 "give a block of threads enough memory for this body");

  Room room;
  const std::size_t lanes = view.width * view.batch_count;
  const std::size_t rates = room.add<Number>(view.is_viscous ? 3 * view.node_count + 1 : 0);
  const std::size_t forces = room.add<Number>(kept == BlockMemory::displacements ? view.force_number_count : 0);
  const std::size_t branches = room.add<Number>(view.branch_number_count);
  const std::size_t walls = room.add<Number>(lanes);
  const std::size_t sides = room.add<Number>(2 * lanes);
  const std::size_t faces = room.add<Number>(view.width * view.face_batch_count);
  scratch_ = io::DeviceArray<std::byte>(room.size());
  io::check_cuda(cudaMemsetAsync(scratch_.get(), 0, room.size(), stream_.get()), "clear memory");
  const auto at = [&](std::size_t offset) { return reinterpret_cast<Number*>(scratch_.get() + offset); };
  task_.memory.rates_m_per_s = at(rates);
  task_.memory.forces_N = at(forces);
  task_.memory.branches = at(branches);
  task_.memory.wall_volumes_m3 = at(walls);
  task_.memory.side_volumes_m3 = at(sides);
  task_.memory.face_volumes_m3 = at(faces);
  take_room(0);
}

/// Takes memory for the state of the body with so many pressures.
template <class Number>
void CudaSteps<Number>::take_room(std::size_t pressure_count) {
  const BodyView<Number>& view = task_.body;
  Room room;
  room.add<detail::BlockOutcome>(1);
  const std::size_t volumes = room.add<double>(2 * view.plenum_count);
  displacements_at_ = room.add<double>(3 * view.node_count);
  velocities_at_ = room.add<double>(3 * view.node_count);
  branches_at_ = room.add<Number>(arrays_.given_branch_count());
  pressures_at_ = room.add<double>(pressure_count + 2);
  state_ = io::DeviceArray<std::byte>(room.size());
  host_ = io::PinnedArray<std::byte>(room.size());
  task_.outcome = reinterpret_cast<detail::BlockOutcome*>(state_.get());
  task_.volumes_m3 = reinterpret_cast<double*>(state_.get() + volumes);
  task_.memory.displacements_m = reinterpret_cast<double*>(state_.get() + displacements_at_);
  task_.memory.velocities_m_per_s = reinterpret_cast<double*>(state_.get() + velocities_at_);
  task_.memory.given_branches = reinterpret_cast<Number*>(state_.get() + branches_at_);
  task_.memory.pressures_Pa = reinterpret_cast<double*>(state_.get() + pressures_at_);
  task_.host_state = reinterpret_cast<uint4*>(host_.get());
  task_.device_state = reinterpret_cast<uint4*>(state_.get());
  task_.given_words = pressures_at_ / sizeof(uint4);
}

template <class Number>
std::string CudaSteps<Number>::text() const {
  return std::string("CUDA, ") + (sizeof(Number) == 4 ? "single" : "double") + " precision";
}

template <class Number>
StepsOutcome CudaSteps<Number>::take(const StepsOrder& order, const MovedBody& body) {
  const std::size_t pressure_bytes = order.pressures_Pa.size() * sizeof(double);
  if (pressures_at_ + pressure_bytes + sizeof(uint4) > state_.size()) take_room(2 * order.pressures_Pa.size());
  auto& branches = std::get<AlignedVector<Number>>(body.branches);
  std::byte* host = host_.get();
  const std::size_t motion_bytes = body.displacements_m.size() * sizeof(double);
  const std::size_t branch_bytes = branches.size() * sizeof(Number);
  std::memcpy(host + displacements_at_, body.displacements_m.data(), motion_bytes);
  std::memcpy(host + velocities_at_, body.velocities_m_per_s.data(), motion_bytes);
  if (branch_bytes > 0) std::memcpy(host + branches_at_, branches.data(), branch_bytes);
  std::memcpy(host + pressures_at_, order.pressures_Pa.data(), pressure_bytes);
  task_.order = detail::block_order(order);

  task_.words = (pressures_at_ + pressure_bytes + sizeof(uint4) - 1) / sizeof(uint4);
  kernel_<<<1, threads, block_bytes_, stream_.get()>>>(task_);
  io::check_cuda(cudaGetLastError(), "take steps");
  stream_.wait();

  detail::BlockOutcome outcome;
  std::memcpy(&outcome, host, sizeof(outcome));
  std::memcpy(body.displacements_m.data(), host + displacements_at_, motion_bytes);
  std::memcpy(body.velocities_m_per_s.data(), host + velocities_at_, motion_bytes);
  if (branch_bytes > 0) std::memcpy(branches.data(), host + branches_at_, branch_bytes);
  const auto* volumes =
      reinterpret_cast<const double*>(host + (reinterpret_cast<const std::byte*>(task_.volumes_m3) - state_.get()));
  return detail::outcome_of(outcome, {volumes, 2 * task_.body.plenum_count});
}

template class CudaSteps<float>;
template class CudaSteps<double>;

}  // namespace menger::fem
