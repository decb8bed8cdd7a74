#include "io/device/memory_arena.h"

#include <iterator>

namespace menger::io {

std::optional<std::size_t> MemoryArena::take(std::size_t size) {
  const std::size_t wanted = rounded(size);
  std::unique_lock lock(mutex_);
  if (wanted > size_) return std::nullopt;
  for (;;) {
    for (auto piece = free_.begin(); piece != free_.end(); ++piece) {
      if (piece->second < wanted) continue;
      const std::size_t begin = piece->first;
      const std::size_t rest = piece->second - wanted;
      free_.erase(piece);
      if (rest > 0) free_.emplace(begin + wanted, rest);
      return begin;
    }
    given_back_.wait(lock);
  }
}

void MemoryArena::give_back(std::size_t begin, std::size_t size) {
  {
    const std::scoped_lock lock(mutex_);
    auto piece = free_.emplace(begin, rounded(size)).first;
    const auto next = std::next(piece);
    if (next != free_.end() && piece->first + piece->second == next->first) {
      piece->second += next->second;
      free_.erase(next);
    }
    if (piece != free_.begin()) {
      const auto before = std::prev(piece);
      if (before->first + before->second == piece->first) {
        before->second += piece->second;
        free_.erase(piece);
      }
    }
  }
  given_back_.notify_all();
}

}  // namespace menger::io
