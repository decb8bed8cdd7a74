#include "io/picture/scale_bar.h"

#include <gtest/gtest.h>

namespace menger::io {
namespace {

TEST(ScaleBar, HasTheLongestRoundLengthThatFits) {
  EXPECT_DOUBLE_EQ(scale_bar_length(0.0123), 0.01);
  EXPECT_DOUBLE_EQ(scale_bar_length(0.0199), 0.01);
  EXPECT_DOUBLE_EQ(scale_bar_length(0.02), 0.02);
  EXPECT_DOUBLE_EQ(scale_bar_length(4.9), 2.0);
  EXPECT_DOUBLE_EQ(scale_bar_length(99.0), 50.0);
}

}  // namespace
}  // namespace menger::io
