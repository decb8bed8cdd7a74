#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace menger::io {

/// Does the pieces 0, 1, ... of some work in several threads. Each thread takes the next piece that no thread has begun.
/// @param threads >= 1; may exceed the number of pieces
/// @param stop no piece is begun once it is true; may be null
/// @param work thread-safe; returns whether its piece was done; after false no further piece is begun
/// @return whether all pieces were done. After an exception of `work` no further piece is begun; the exception is thrown again
/// once all threads have ended.
bool side_by_side(std::size_t pieces, int threads, const std::atomic<bool>* stop, const std::function<bool(std::size_t)>& work);

}  // namespace menger::io
