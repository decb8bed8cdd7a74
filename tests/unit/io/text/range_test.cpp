#include "io/text/range.h"

#include <gtest/gtest.h>

#include <cmath>

namespace menger::io {
namespace {

TEST(Range, IncludesOrExcludesItsEnds) {
  EXPECT_FALSE(positive().contains(0.0));
  EXPECT_TRUE(positive().contains(5e-324));
  EXPECT_TRUE(non_negative().contains(0.0));
  EXPECT_FALSE(non_negative().contains(-5e-324));
  EXPECT_TRUE(within(0.0, 1.0).contains(0.0));
  EXPECT_TRUE(within(0.0, 1.0).contains(1.0));
  EXPECT_FALSE(within(0.0, 1.0).contains(std::nextafter(1.0, 2.0)));
  EXPECT_FALSE(between(0.0, 1.0).contains(0.0));
  EXPECT_FALSE(between(0.0, 1.0).contains(1.0));
  EXPECT_TRUE(at_least(3.0).contains(3.0));
  EXPECT_TRUE(at_most(3.0).contains(3.0));
}

TEST(Range, ContainsNoNan) {
  EXPECT_FALSE(any_number().contains(std::nan("")));
  EXPECT_FALSE(positive().contains(std::nan("")));
}

TEST(Range, SaysWhatItDemands) {
  EXPECT_EQ(any_number().demand(), "");
  EXPECT_EQ(positive().demand(), "must be > 0");
  EXPECT_EQ(non_negative().demand(), "must be >= 0");
  EXPECT_EQ(at_most(0.5).demand(), "must be <= 0.5");
  EXPECT_EQ(within(-1, 1).demand(), "must be in [-1, 1]");
  EXPECT_EQ(between(0, 1).demand(), "must be in (0, 1)");
}

}  // namespace
}  // namespace menger::io
