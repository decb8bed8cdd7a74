#include "io/process/side_by_side.h"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

namespace menger::io {
namespace {

TEST(SideBySide, DoesEveryPieceOnce) {
  std::array<std::atomic<int>, 50> counts{};
  EXPECT_TRUE(side_by_side(counts.size(), 4, nullptr, [&](std::size_t n) { return ++counts.at(n) == 1; }));
  for (const auto& count : counts) EXPECT_EQ(count, 1);
  EXPECT_TRUE(side_by_side(0, 4, nullptr, [](std::size_t) { return false; })) << "nothing to do is done";
}

TEST(SideBySide, BeginsNoMoreOnceItIsToStop) {
  std::atomic<bool> stop{false};
  std::atomic<int> done{0};
  const auto work = [&](std::size_t) {
    stop = ++done == 3;
    return true;
  };
  EXPECT_FALSE(side_by_side(10, 1, &stop, work));
  EXPECT_EQ(done, 3);
  std::atomic<int> tried{0};
  EXPECT_FALSE(side_by_side(10, 1, nullptr, [&](std::size_t n) {
    ++tried;
    return n < 4;
  }));
  EXPECT_EQ(tried, 5);
}

TEST(SideBySide, PassesOnWhatAPieceThrows) {
  std::atomic<int> tried{0};
  EXPECT_THROW((void)side_by_side(10, 2, nullptr,
                                  [&](std::size_t) -> bool {
                                    ++tried;
                                    throw std::runtime_error("broken");
                                  }),
               std::runtime_error);
  EXPECT_LE(tried, 2);
}

}  // namespace
}  // namespace menger::io
