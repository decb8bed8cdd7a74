#include "io/text/input_error.h"

#include <gtest/gtest.h>

namespace menger::io {
namespace {

TEST(InputErrorMessage, HoldsNothingThatATerminalObeys) {
  EXPECT_STREQ(InputError("a.csv:2: kind = \x1b]0;title\x07: is no kind").what(),
               "a.csv:2: kind = \\u001B]0;title\\u0007: is no kind");
}

}  // namespace
}  // namespace menger::io
