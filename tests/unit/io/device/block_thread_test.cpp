#include "io/device/block_thread.h"

#include <gtest/gtest.h>

#include "io/device/graphics_processor.h"

namespace menger::io {
namespace {

TEST(LoneThread, DoesAllItemsItself) {
  const LoneThread thread;
  int sum = 0;
  for (std::size_t n = thread.index(); n < 5; n += thread.count()) sum += 1;
  EXPECT_EQ(sum, 5);
  EXPECT_TRUE(thread.any(true));
  EXPECT_FALSE(thread.any(false));
  EXPECT_EQ(thread.sum(2.5), 2.5);
}

TEST(GraphicsProcessor, IsThereOrItIsSaidWhyNot) {
  const auto processor = graphics_processor();
  EXPECT_EQ(processor.has_value(), obstacle_to_device().empty()) << obstacle_to_device();
  if (processor) {
    EXPECT_GT(processor->multiprocessors, 0);
    EXPECT_GT(processor->memory_bytes, 0.0);
  }
}

}  // namespace
}  // namespace menger::io
