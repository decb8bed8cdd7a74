#pragma once

#include <cstddef>

namespace menger::io {

/// A thread of a CUDA block, see LoneThread. The block has a multiple of 32 threads, at most 1024.
/// @param memory of the block: 32 numbers
class CudaBlockThread {
 public:
  static constexpr std::size_t memory_numbers = 32;

  __device__ explicit CudaBlockThread(double* memory) : memory_(memory) {}

  __device__ static std::size_t index() { return threadIdx.x; }
  __device__ static std::size_t count() { return blockDim.x; }
  __device__ static std::size_t lane() { return threadIdx.x % 32; }
  __device__ static std::size_t batch() { return threadIdx.x / 32; }
  __device__ static std::size_t batch_count() { return blockDim.x / 32; }

  __device__ static void wait() { __syncthreads(); }
  __device__ static bool any(bool condition) { return __syncthreads_or(condition ? 1 : 0) != 0; }

  __device__ double sum(double value) const {
    for (int apart = 16; apart > 0; apart /= 2) value += __shfl_down_sync(all_lanes, value, apart);
    __syncthreads();
    if (lane() == 0) memory_[batch()] = value;
    __syncthreads();
    double total = 0.0;
    for (std::size_t n = 0; n < batch_count(); ++n) total += memory_[n];
    return total;
  }

  __device__ float largest(float value) const {
    // Numbers that are not negative are ordered as their bits are; what is not a number comes last.
    unsigned bits = __reduce_max_sync(all_lanes, __float_as_uint(value));
    __syncthreads();
    if (lane() == 0) reinterpret_cast<unsigned*>(memory_)[batch()] = bits;
    __syncthreads();
    for (std::size_t n = 0; n < batch_count(); ++n) bits = max(bits, reinterpret_cast<unsigned*>(memory_)[n]);
    return __uint_as_float(bits);
  }

 private:
  static constexpr unsigned all_lanes = 0xffffffffU;
  double* memory_;
};

}  // namespace menger::io
