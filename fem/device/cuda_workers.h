#pragma once

// Only where menger is built with CUDA.

#include <cstddef>
#include <cstdint>
#include <mutex>

#include "fem/device/cuda_steps.h"
#include "io/device/device_memory.h"
#include "io/device/memory_arena.h"

namespace menger::fem {

/// The memory that all bodies on the graphics processor share.
class CudaArenas {
 public:
  static CudaArenas& of_process();

  io::MemoryArena host;
  io::MemoryArena device;
  [[nodiscard]] std::byte* host_memory() const { return host_memory_.get(); }
  [[nodiscard]] std::byte* device_memory() const { return device_memory_.get(); }
  /// Fast memory of a block, bytes.
  [[nodiscard]] std::size_t block_bytes() const { return block_bytes_; }

 private:
  CudaArenas(std::size_t host_size, std::size_t device_size);

  io::PinnedArray<std::byte> host_memory_;
  io::DeviceArray<std::byte> device_memory_;
  std::size_t block_bytes_ = 0;
};

/// Blocks of threads that work on orders in turn, one on each multiprocessor. Their kernel runs as long as there are orders: an
/// order costs no launch, and none waits for the end of others that came before it. Bodies of one law and number type have the
/// same workers.
template <class Number>
class CudaWorkers {
 public:
  /// @param law place in materials::HyperelasticLaw
  static CudaWorkers& of_law(std::size_t law);

  /// Returns the fast memory that a body needs of its block, bytes.
  static std::size_t block_bytes(const BodyView<Number>& body, BlockMemory kept);

  /// Lets a block do a task, and waits for its end. Thread-safe. @throws io::DeviceError
  void run(CudaTask<Number>& task);

 private:
  explicit CudaWorkers(std::size_t law);
  void begin();
  void end();
  void post(const CudaTask<Number>& task);

  static constexpr std::uint32_t capacity = 1024;  ///< tasks that are posted and not begun, at most
  std::size_t law_;
  std::uint32_t blocks_ = 0;
  std::mutex mutex_;
  std::size_t waiting_ = 0;  ///< threads for the end of their tasks
  std::uint32_t next_ticket_ = 0;
  io::DeviceStream stream_;
  io::DeviceArray<std::uint32_t> tickets_;  ///< one: the next to be drawn by a block
  io::PinnedArray<CudaTask<Number>> tasks_;
  io::PinnedArray<std::uint32_t> posted_;  ///< per task: 1 + its ticket
};

}  // namespace menger::fem
