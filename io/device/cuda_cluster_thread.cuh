#pragma once

#include <cooperative_groups.h>

#include <cstddef>

#include "io/device/cuda_block_thread.cuh"

namespace menger::io {

#if !defined(__CUDA_ARCH__) || __CUDA_ARCH__ >= 900  // there are no clusters on older cards

/// A thread of several CUDA blocks that work on one robot together, see LoneThread. They are a cluster: its blocks run at the
/// same time on multiprocessors near each other, wait for each other, and write into each other's memory. Needs compute
/// capability 9.0.
///
/// What one block has written to the memory of the card others read after a wait.
class CudaClusterThread {
 public:
  static constexpr std::size_t most_blocks = 16;
  static constexpr std::size_t memory_numbers = CudaBlockThread::memory_numbers + 2 * most_blocks;

  /// @param memory of the block: memory_numbers numbers, at the same place in all blocks
  __device__ explicit CudaClusterThread(double* memory)
      : block_(memory),
        exchanged_(memory + CudaBlockThread::memory_numbers),
        rank_(cooperative_groups::this_cluster().block_rank()),
        blocks_(cooperative_groups::this_cluster().num_blocks()) {}

  __device__ std::size_t index() const { return rank_ * blockDim.x + threadIdx.x; }
  __device__ std::size_t count() const { return blocks_ * blockDim.x; }

  __device__ static void wait() { cooperative_groups::this_cluster().sync(); }

  __device__ bool any(bool condition) {
    const double* const of_blocks = exchange(CudaBlockThread::any(condition) ? 1.0 : 0.0);
    bool is_any = false;
    for (unsigned n = 0; n < blocks_; ++n) is_any = is_any || of_blocks[n] != 0.0;
    return is_any;
  }

  __device__ double sum(double value) {
    const double* const of_blocks = exchange(block_.sum(value));
    double total = 0.0;
    for (unsigned n = 0; n < blocks_; ++n) total += of_blocks[n];
    return total;
  }

 private:
  /// Tells all blocks a number of this one, and returns those of all.
  __device__ const double* exchange(double value) {
    // Two halves by turns: what is read from one is not written over before all have passed the next wait.
    is_second_ = !is_second_;
    double* const own = exchanged_ + (is_second_ ? most_blocks : 0);
    if (threadIdx.x < blocks_) *cooperative_groups::this_cluster().map_shared_rank(own + rank_, threadIdx.x) = value;
    wait();
    return own;
  }

  CudaBlockThread block_;
  double* exchanged_;
  unsigned rank_, blocks_;
  bool is_second_ = false;
};

#endif

}  // namespace menger::io
