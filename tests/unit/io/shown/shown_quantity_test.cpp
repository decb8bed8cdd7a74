#include "io/shown/shown_quantity.h"

#include <gtest/gtest.h>

namespace menger::io {
namespace {

TEST(ShownQuantity, HasTheUnitsOfFigures) {
  EXPECT_EQ(kilopascals(3042.0), "3.04 kPa");
  EXPECT_EQ(kilopascals(15937.8, 4), "15.94 kPa");
  EXPECT_EQ(millimetres(0.00296), "2.96 mm");
}

TEST(ShownQuantity, TellsWhatRoundingLeavesAsNothing) {
  EXPECT_EQ(millimetres(1.55e-9), "0 mm");
  EXPECT_EQ(millimetres(-1.55e-9), "0 mm");
  EXPECT_EQ(millimetres(1.55e-8), "1.55e-05 mm");
  EXPECT_EQ(body_lengths(-2.3e-7), "0 body lengths");
}

TEST(ShownQuantity, WritesNoShareWithAPowerOfTen) {
  EXPECT_EQ(percents(0.0662), "6.6 %");
  EXPECT_EQ(percents(0.0999), "10 %");
  EXPECT_EQ(percents(0.5), "50 %");
  EXPECT_EQ(percents(1.27), "127 %");
  EXPECT_EQ(percents(12.7), "1270 %");
  EXPECT_EQ(percents(0.0), "0 %");
  EXPECT_EQ(percents(-0.5), "-50 %");
}

TEST(ShownQuantity, SpeaksOfOneBodyLength) {
  EXPECT_EQ(body_lengths(3.9e-5), "0 body lengths");
  EXPECT_EQ(body_lengths(1.033), "1 body length");
  EXPECT_EQ(body_lengths(0.319), "0.32 body lengths");
  EXPECT_EQ(body_lengths(2.25), "2.2 body lengths");
}

TEST(ShownQuantity, DegreesAreWhole) {
  EXPECT_EQ(degrees(1.2), "1 degree");
  EXPECT_EQ(degrees(-1.2), "-1 degree");
  EXPECT_EQ(degrees(-0.3), "0 degrees");
  EXPECT_EQ(degrees(179.6), "180 degrees");
}

TEST(ShownQuantity, SafePressuresAreNotRoundedToUnsafeOnes) {
  EXPECT_EQ(rounded_towards_rest(4879.0), 4870.0);
  EXPECT_EQ(rounded_towards_rest(-427.9), -427.0);
  EXPECT_EQ(rounded_towards_rest(4870.0), 4870.0) << "what is rounded stays";
  EXPECT_EQ(pascals_towards_rest(12345.0), "12300 Pa");
}

}  // namespace
}  // namespace menger::io
