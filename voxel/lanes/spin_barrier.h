#pragma once

#include <atomic>
#include <thread>

namespace menger::voxel {

/// A barrier for threads that share the work of one step. They meet every few microseconds, so a waiting thread checks repeatedly
/// before it lets another thread have the core.
class SpinBarrier {
 public:
  /// @param threads >= 1
  explicit SpinBarrier(int threads) : threads_(threads) {}

  /// Sets how many threads meet from now on. Precondition: no thread is waiting. @param threads >= 1
  void set_threads(int threads) { threads_ = threads; }

  /// Waits until all threads have called it. Afterwards each thread sees all that the others wrote before.
  void meet() {
    meet([] {});
  }

  /// Waits in the same way; the last thread to arrive does some work before any thread returns. The work must not throw, because
  /// the other threads would wait for ever.
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
    constexpr int patience = 2000;  // checks, about 20 microseconds
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
