#include "io/device/memory_arena.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace menger::io {
namespace {

TEST(MemoryArena, SharesOutPiecesThatDoNotOverlap) {
  MemoryArena arena(10 * MemoryArena::alignment);
  const auto a = arena.take(1);
  const auto b = arena.take(MemoryArena::alignment + 1);
  const auto c = arena.take(7 * MemoryArena::alignment);
  ASSERT_TRUE(a && b && c);
  EXPECT_EQ(*b - *a, MemoryArena::alignment);
  EXPECT_EQ(*c - *b, 2 * MemoryArena::alignment);
}

TEST(MemoryArena, JoinsPiecesThatComeBack) {
  MemoryArena arena(4 * MemoryArena::alignment);
  std::vector<std::size_t> pieces;
  for (int n = 0; n < 4; ++n) pieces.push_back(*arena.take(MemoryArena::alignment));
  for (const std::size_t n : {1U, 3U, 0U, 2U}) arena.give_back(pieces[n], MemoryArena::alignment);
  EXPECT_EQ(arena.take(4 * MemoryArena::alignment), std::size_t{0});
}

TEST(MemoryArena, RefusesWhatIsLargerThanAllOfIt) {
  MemoryArena arena(4 * MemoryArena::alignment);
  EXPECT_FALSE(arena.take(4 * MemoryArena::alignment + 1).has_value());
  EXPECT_TRUE(arena.take(4 * MemoryArena::alignment).has_value());
}

TEST(MemoryArena, LetsThreadsWaitForWhatComesBack) {
  MemoryArena arena(2 * MemoryArena::alignment);
  std::vector<std::jthread> threads;
  std::atomic<int> done = 0;
  for (int n = 0; n < 8; ++n)
    threads.emplace_back([&] {
      for (int k = 0; k < 100; ++k) {
        const auto piece = arena.take(MemoryArena::alignment);
        ASSERT_TRUE(piece);
        arena.give_back(*piece, MemoryArena::alignment);
      }
      ++done;
    });
  threads.clear();
  EXPECT_EQ(done, 8);
}

}  // namespace
}  // namespace menger::io
