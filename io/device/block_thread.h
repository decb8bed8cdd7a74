#pragma once

#include <cstddef>

#include "io/device/host_device.h"

namespace menger::io {

/// A block of threads that work on one robot together, as each of them sees it. Code that is written for such a thread takes
/// every count()-th item from index() on, and calls wait() before it reads what others have written.
///
/// This is a block of one thread. On a processor without CUDA the code of blocks runs as this, which is how it is tested where
/// there is no graphics processor. See CudaBlockThread.
class LoneThread {
 public:
  MENGER_HOST_DEVICE static constexpr std::size_t index() { return 0; }
  MENGER_HOST_DEVICE static constexpr std::size_t count() { return 1; }

  /// Lanes are threads that run in step and share the items of a batch: lane() of batch number batch(), batch_count() at once.
  MENGER_HOST_DEVICE static constexpr std::size_t lane() { return 0; }
  MENGER_HOST_DEVICE static constexpr std::size_t batch() { return 0; }
  MENGER_HOST_DEVICE static constexpr std::size_t batch_count() { return 1; }

  /// Waits for all threads of the block.
  MENGER_HOST_DEVICE static void wait() {}
  /// Whether this holds for any thread; waits for all of them.
  MENGER_HOST_DEVICE static bool any(bool condition) { return condition; }
  /// The sum over all threads, added up in an order that depends on their number only; waits for all of them.
  MENGER_HOST_DEVICE static double sum(double value) { return value; }
  /// The largest number of all threads, none below zero; waits for all of them.
  MENGER_HOST_DEVICE static float largest(float value) { return value; }
};

}  // namespace menger::io
