#pragma once

#include <cstddef>

namespace menger::io {

/// A thread of a CUDA block, see LoneThread. The block has a multiple of 32 threads, at most 1024.
class CudaBlockThread {
 public:
  static constexpr std::size_t memory_numbers = 64;

  /// @param memory of the block: memory_numbers numbers
  __device__ explicit CudaBlockThread(double* memory) : memory_(memory) {}

  __device__ static std::size_t index() { return threadIdx.x; }
  __device__ static std::size_t count() { return blockDim.x; }
  __device__ static std::size_t lane() { return threadIdx.x % 32; }
  __device__ static std::size_t batch() { return threadIdx.x / 32; }
  __device__ static std::size_t batch_count() { return blockDim.x / 32; }

  __device__ static void wait() { __syncthreads(); }
  __device__ static bool any(bool condition) { return __syncthreads_or(condition ? 1 : 0) != 0; }

  __device__ double sum(double value) {
    for (int apart = 16; apart > 0; apart /= 2) value += __shfl_down_sync(all_lanes, value, apart);
    double* const own = next_memory();
    if (lane() == 0) own[batch()] = value;
    __syncthreads();
    double total = 0.0;
    for (std::size_t n = 0; n < batch_count(); ++n) total += own[n];
    return total;
  }

  __device__ float largest(float value) {
    // Numbers that are not negative are ordered as their bits are; what is not a number comes last.
    unsigned bits = __reduce_max_sync(all_lanes, __float_as_uint(value));
    auto* const own = reinterpret_cast<unsigned*>(next_memory());
    if (lane() == 0) own[batch()] = bits;
    __syncthreads();
    for (std::size_t n = 0; n < batch_count(); ++n) bits = max(bits, own[n]);
    return __uint_as_float(bits);
  }

 private:
  static constexpr unsigned all_lanes = 0xffffffffU;

  /// Two halves by turns: what is read from one is not written over before all have passed the next wait.
  __device__ double* next_memory() {
    is_second_ = !is_second_;
    return memory_ + (is_second_ ? memory_numbers / 2 : 0);
  }

  double* memory_;
  bool is_second_ = false;
};

}  // namespace menger::io
