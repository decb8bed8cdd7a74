#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <memory>
#include <thread>
#include <variant>
#include <vector>

#include "fem/device/cuda_workers.h"
#include "fem/device/warp_number.cuh"
#include "io/device/cuda_block_thread.cuh"
#include "materials/laws/hyperelastic_law.h"

namespace menger::fem {
namespace {

using detail::WarpNumber;

/// Threads of a block: as many as have enough registers for the forces of an element.
template <class Number>
constexpr int threads_of = sizeof(Number) == 4 ? 256 : 128;

constexpr std::size_t for_sums = sizeof(double) * io::CudaBlockThread::memory_numbers;

__host__ __device__ constexpr std::size_t aligned(std::size_t bytes) { return (bytes + 15) / 16 * 16; }

/// Where arrays begin in the memory of a block, bytes.
struct BlockPlaces {
  std::size_t forces = 0, displacements = 0, velocities = 0, end = 0;
};

template <class Number>
__host__ __device__ BlockPlaces places_of(const BodyView<Number>& body, BlockMemory kept) {
  BlockPlaces places;
  std::size_t end = for_sums + aligned(sizeof(Number) * (3 * body.node_count + 1));
  places.forces = end;
  if (kept != BlockMemory::displacements) end += aligned(sizeof(Number) * body.force_number_count);
  places.displacements = end;
  if (kept == BlockMemory::motion) end += aligned(sizeof(double) * 3 * body.node_count);
  places.velocities = end;
  if (kept == BlockMemory::motion) end += aligned(sizeof(double) * 3 * body.node_count);
  places.end = end;
  return places;
}

/// Copies words by all threads of a block, several at once, since memory of the other processor answers late. What is read there
/// is not kept in a cache.
__device__ void copy_words(const uint4* from, std::size_t count, uint4* to) {
  constexpr std::size_t at_once = 8;
  for (std::size_t first = threadIdx.x; first < count; first += at_once * blockDim.x) {
    uint4 words[at_once];
#pragma unroll
    for (std::size_t n = 0; n < at_once; ++n)
      if (first + n * blockDim.x < count) words[n] = __ldcv(from + first + n * blockDim.x);
#pragma unroll
    for (std::size_t n = 0; n < at_once; ++n)
      if (first + n * blockDim.x < count) to[first + n * blockDim.x] = words[n];
  }
}

/// Takes the steps of a body with these of its arrays in the memory of the block.
template <class Law, class Number, BlockMemory kept>
__device__ __noinline__ void take_steps(const CudaTask<Number>& task, std::byte* block_memory) {
  const BlockPlaces places = places_of(task.body, kept);
  StepsMemory<Number> memory = task.memory;
  memory.values_m = reinterpret_cast<Number*>(block_memory + for_sums);
  if constexpr (kept != BlockMemory::displacements) memory.forces_N = reinterpret_cast<Number*>(block_memory + places.forces);
  const std::size_t count = 3 * task.body.node_count;
  if constexpr (kept == BlockMemory::motion) {
    memory.displacements_m = reinterpret_cast<double*>(block_memory + places.displacements);
    memory.velocities_m_per_s = reinterpret_cast<double*>(block_memory + places.velocities);
    for (std::size_t n = threadIdx.x; n < count; n += blockDim.x) {
      memory.displacements_m[n] = task.memory.displacements_m[n];
      memory.velocities_m_per_s[n] = task.memory.velocities_m_per_s[n];
    }
  }
  io::CudaBlockThread thread(reinterpret_cast<double*>(block_memory));
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
}

template <class Number>
struct Queue {
  std::uint32_t* tickets;
  const CudaTask<Number>* tasks;
  const std::uint32_t* posted;
  std::uint32_t capacity;
};

/// Words of a task in the memory of a block.
template <class Number>
constexpr std::size_t task_words = (sizeof(CudaTask<Number>) + sizeof(uint4) - 1) / sizeof(uint4);

/// A block that does tasks until one says that there are no more.
template <class Law, class Number>
__global__ __launch_bounds__(threads_of<Number>) void work(Queue<Number> queue) {
  extern __shared__ double2 block_memory[];
  __shared__ uint4 task_memory[task_words<Number>];
  __shared__ std::uint32_t ticket;
  auto* const bytes = reinterpret_cast<std::byte*>(block_memory);
  const auto& task = *reinterpret_cast<const CudaTask<Number>*>(task_memory);
  for (;;) {
    if (threadIdx.x == 0) {
      ticket = atomicAdd(queue.tickets, 1U);
      while (__ldcv(queue.posted + ticket % queue.capacity) != ticket + 1) __nanosleep(500);
    }
    __syncthreads();
    __threadfence_system();  // what follows sees what was there when the task was posted
    copy_words(reinterpret_cast<const uint4*>(queue.tasks + ticket % queue.capacity), task_words<Number>, task_memory);
    __syncthreads();
    if (task.ends) return;
    copy_words(task.host_arrays, task.array_words, task.arrays);
    copy_words(task.host_state, task.words, task.state);
    __syncthreads();
    if (task.kept == BlockMemory::motion) {
      take_steps<Law, Number, BlockMemory::motion>(task, bytes);
    } else if (task.kept == BlockMemory::forces) {
      take_steps<Law, Number, BlockMemory::forces>(task, bytes);
    } else {
      take_steps<Law, Number, BlockMemory::displacements>(task, bytes);
    }
    __syncthreads();
    copy_words(task.state, task.given_words, task.host_state);
    __threadfence_system();
    __syncthreads();
    if (threadIdx.x == 0) __stwt(task.done, 1U);
    __syncthreads();
  }
}

template <class Number>
using Kernel = void (*)(Queue<Number>);

template <class Number, class... Laws>
Kernel<Number> kernel_of(std::size_t law, const std::variant<Laws...>*) {
  static constexpr Kernel<Number> kernels[] = {work<Laws, Number>...};
  return kernels[law];
}

template <class Number>
Kernel<Number> kernel_of(std::size_t law) {
  return kernel_of<Number>(law, static_cast<const materials::HyperelasticLaw*>(nullptr));
}

int attribute(cudaDeviceAttr which) {
  int value = 0;
  io::check_cuda(cudaDeviceGetAttribute(&value, which, 0), "ask for the properties of the device");
  return value;
}

std::size_t device_arena_size() {
  std::size_t free = 0;
  std::size_t total = 0;
  io::check_cuda(cudaMemGetInfo(&free, &total), "ask for its memory");
  return std::min(free / 2, std::size_t{4} << 30U);
}

constexpr std::size_t host_arena_size = std::size_t{512} << 20U;

}  // namespace

CudaArenas& CudaArenas::of_process() {
  static CudaArenas arenas(host_arena_size, device_arena_size());
  return arenas;
}

CudaArenas::CudaArenas(std::size_t host_size, std::size_t device_size)
    : host(host_size),
      device(device_size),
      host_memory_(host_size),
      device_memory_(device_size),
      block_bytes_(static_cast<std::size_t>(attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin)) - 2048) {}

template <class Number>
CudaWorkers<Number>& CudaWorkers<Number>::of_law(std::size_t law) {
  static std::mutex mutex;
  static std::unique_ptr<CudaWorkers> workers[std::variant_size_v<materials::HyperelasticLaw>];
  const std::scoped_lock lock(mutex);
  if (!workers[law]) workers[law].reset(new CudaWorkers(law));
  return *workers[law];
}

template <class Number>
CudaWorkers<Number>::CudaWorkers(std::size_t law)
    : law_(law),
      blocks_(static_cast<std::uint32_t>(attribute(cudaDevAttrMultiProcessorCount))),
      tickets_(1),
      tasks_(capacity),
      posted_(capacity) {
  static_assert(sizeof(CudaTask<Number>) % sizeof(uint4) == 0);
  io::check_cuda(
      cudaFuncSetAttribute(reinterpret_cast<const void*>(kernel_of<Number>(law)), cudaFuncAttributeMaxDynamicSharedMemorySize,
                           static_cast<int>(CudaArenas::of_process().block_bytes())),
      "give blocks of threads their memory");
}

template <class Number>
std::size_t CudaWorkers<Number>::block_bytes(const BodyView<Number>& body, BlockMemory kept) {
  return places_of(body, kept).end;
}

template <class Number>
void CudaWorkers<Number>::begin() {
  next_ticket_ = 0;
  std::fill_n(posted_.get(), capacity, 0U);
  io::check_cuda(cudaMemsetAsync(tickets_.get(), 0, sizeof(std::uint32_t), stream_.get()), "clear the queue");
  kernel_of<Number>(law_)<<<blocks_, threads_of<Number>, CudaArenas::of_process().block_bytes(), stream_.get()>>>(
      {tickets_.get(), tasks_.get(), posted_.get(), capacity});
  io::check_cuda(cudaGetLastError(), "begin to work");
}

template <class Number>
void CudaWorkers<Number>::post(const CudaTask<Number>& task) {
  const std::uint32_t slot = next_ticket_ % capacity;
  std::memcpy(static_cast<void*>(tasks_.get() + slot), &task, sizeof(task));
  std::atomic_ref(posted_.get()[slot]).store(next_ticket_ + 1, std::memory_order_release);
  ++next_ticket_;
}

/// Each block waits for one task.
template <class Number>
void CudaWorkers<Number>::end() {
  CudaTask<Number> last;
  last.ends = true;
  for (std::uint32_t n = 0; n < blocks_; ++n) post(last);
  stream_.wait();
}

template <class Number>
void CudaWorkers<Number>::run(CudaTask<Number>& task) {
  using Clock = std::chrono::steady_clock;
  *task.done = 0;
  {
    const std::scoped_lock lock(mutex_);
    if (waiting_ == 0) begin();
    ++waiting_;
    post(task);
  }
  const auto start = Clock::now();
  const std::atomic_ref<std::uint32_t> done(*task.done);
  std::string fault;
  for (std::size_t looks = 1; done.load(std::memory_order_acquire) == 0; ++looks) {
    // There are more waiting threads than cores: none looks more often than it matters.
    const auto pause =
        std::clamp<Clock::duration>((Clock::now() - start) / 16, std::chrono::microseconds(10), std::chrono::microseconds(200));
    std::this_thread::sleep_for(pause);
    if (looks % 1000 != 0) continue;
    const cudaError_t code = cudaStreamQuery(stream_.get());
    if (code != cudaErrorNotReady && done.load(std::memory_order_acquire) == 0) {
      fault = code == cudaSuccess ? "its blocks have ended" : cudaGetErrorString(code);
      break;
    }
  }
  const std::scoped_lock lock(mutex_);
  --waiting_;
  if (!fault.empty()) throw io::DeviceError("CUDA could not take steps: " + fault);
  if (waiting_ == 0) end();
}

template class CudaWorkers<float>;
template class CudaWorkers<double>;

}  // namespace menger::fem
