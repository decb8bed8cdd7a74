#pragma once

#include <atomic>
#include <thread>

namespace menger::voxel {

/// A meeting point of threads that share the work of one step: they meet every few microseconds, so that whoever waits looks
/// again and again before it lets another thread have the core.
class SpinBarrier {
 public:
  /// @param threads >= 1
  explicit SpinBarrier(int threads) : threads_(threads) {}

  /// Sets how many threads meet from now on. Precondition: none is waiting. @param threads >= 1
  void set_threads(int threads) { threads_ = threads; }

  /// Waits until all threads have called it. Afterwards each sees what the others wrote before.
  void meet() {
    meet([] {});
  }

  /// The same, and before any thread returns the last to come does some work, which must not throw: the others would wait for
  /// ever.
  template <class Work>
  void meet(const Work& work) {
    if (threads_ == 1) {
      work();
      return;
    }
    const unsigned round = round_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads_) {
      work();
      arrived_.store(0, std::memory_order_relaxed);
      round_.store(round + 1, std::memory_order_release);
      return;
    }
    constexpr int patience = 2000;  // looks, some 20 microseconds
    for (int looks = 0; round_.load(std::memory_order_acquire) == round; ++looks) {
      if (looks >= patience) std::this_thread::yield();
    }
  }

 private:
  int threads_;
  alignas(64) std::atomic<int> arrived_{0};
  alignas(64) std::atomic<unsigned> round_{0};
};

}  // namespace menger::voxel
