#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace menger::fem {

/// Runs work on the blocks of a range with several threads. The blocks are the same for any number of threads. Sums per block,
/// added in the order of the blocks, therefore do not depend on that number.
class BlockLoop {
 public:
  /// @param threads number of threads; up to 1: no thread is started
  explicit BlockLoop(int threads) {
    if (threads <= 1) return;
    // Without this, tbb would not start more threads than there are cores. It holds for all loops of the process, so that it is
    // not set where it would only take threads from the others.
    if (threads > tbb::info::default_concurrency())
      allowed_ =
          std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    arena_ = std::make_unique<tbb::task_arena>(threads);
  }

  static std::size_t block_count(std::size_t size, std::size_t block) { return (size + block - 1) / block; }

  /// Calls work(index of the block, begin, end) for every block of the range [0, size).
  template <class Work>
  void run(std::size_t size, std::size_t block, const Work& work) const {
    const std::size_t count = block_count(size, block);
    const auto one = [&](std::size_t n) { work(n, n * block, std::min((n + 1) * block, size)); };
    if (!arena_) {
      for (std::size_t n = 0; n < count; ++n) one(n);
      return;
    }
    arena_->execute([&] { tbb::parallel_for(std::size_t{0}, count, one); });
  }

 private:
  std::unique_ptr<tbb::global_control> allowed_;
  std::unique_ptr<tbb::task_arena> arena_;
};

}  // namespace menger::fem
