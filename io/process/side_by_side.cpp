#include "io/process/side_by_side.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace menger::io {

bool side_by_side(std::size_t pieces, int threads, const std::atomic<bool>* stop, const std::function<bool(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> ends{false};
  std::mutex mutex;
  std::exception_ptr fault;
  const auto loop = [&] {
    for (std::size_t piece = next++; piece < pieces; piece = next++) {
      if (stop != nullptr && stop->load()) ends = true;
      if (ends) return;
      try {
        if (!work(piece)) ends = true;
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!fault) fault = std::current_exception();
        ends = true;
      }
    }
  };
  {
    const std::size_t count = std::min(pieces, static_cast<std::size_t>(std::max(1, threads)));
    std::vector<std::jthread> running;
    running.reserve(count);
    for (std::size_t n = 0; n < count; ++n) running.emplace_back(loop);
  }
  if (fault) std::rethrow_exception(fault);
  return !ends;
}

}  // namespace menger::io
