#pragma once

#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>

namespace menger::io {

/// Shares out one large piece of memory, because a graphics processor that works cannot be asked for more. Knows sizes alone, not
/// where the memory is. Thread-safe.
class MemoryArena {
 public:
  static constexpr std::size_t alignment = 256;

  /// @param size bytes
  explicit MemoryArena(std::size_t size) : free_{{0, size / alignment * alignment}}, size_(size / alignment * alignment) {}

  /// Returns where a free piece begins; waits until others have given back enough. Empty if it is larger than all of the memory.
  [[nodiscard]] std::optional<std::size_t> take(std::size_t size);

  /// Gives a piece back that was taken with this size.
  void give_back(std::size_t begin, std::size_t size);

 private:
  static std::size_t rounded(std::size_t size) { return (size + alignment - 1) / alignment * alignment; }

  std::mutex mutex_;
  std::condition_variable given_back_;
  std::map<std::size_t, std::size_t> free_;  ///< sizes of the free pieces by where they begin; no two of them adjoin
  std::size_t size_;
};

}  // namespace menger::io
