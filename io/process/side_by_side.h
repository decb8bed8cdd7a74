#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace menger::io {

/// Does the pieces 0, 1, ... of some work in threads, each thread the next piece that nobody has begun.
/// @param threads >= 1, more than there are pieces if so asked @param stop no piece is begun once it is true; may be null
/// @param work thread-safe; returns whether its piece was done, false begins no more
/// @return whether all were done. What `work` throws begins no more and is thrown again once the threads are through
bool side_by_side(std::size_t pieces, int threads, const std::atomic<bool>* stop, const std::function<bool(std::size_t)>& work);

}  // namespace menger::io
