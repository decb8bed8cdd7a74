#include "io/picture/chart_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace menger::io {
namespace {

std::vector<std::string> labels_of(const ChartScale& scale) {
  std::vector<std::string> labels;
  for (const ChartTick& tick : scale.ticks()) {
    if (!tick.label.empty()) labels.push_back(tick.label);
  }
  return labels;
}

using Labels = std::vector<std::string>;

TEST(ChartScale, ShowsAllValuesWithAMargin) {
  const ChartScale scale = scale_of({}, {-2.0, 3.0, std::nan("")});
  EXPECT_LT(scale.low, -2.0);
  EXPECT_GT(scale.low, -3.0);
  EXPECT_GT(scale.high, 3.0);
  EXPECT_LT(scale.high, 4.0);
}

TEST(ChartScale, StartsAtZeroIfTheValuesComeNearIt) {
  EXPECT_EQ(scale_of({}, {0.1, 3.0}).low, 0.0);
  EXPECT_GT(scale_of({}, {2.0, 3.0}).low, 1.5);
  EXPECT_EQ(scale_of({}, {-3.0, -0.1}).high, 0.0);
}

TEST(ChartScale, KeepsGivenEnds) {
  const ChartScale scale = scale_of({.lowest = -1.0, .highest = 7.0}, {2.0, 3.0});
  EXPECT_EQ(scale.low, -1.0);
  EXPECT_EQ(scale.high, 7.0);
  // One that the data do not reach leaves an axis all the same.
  const ChartScale beyond = scale_of({.lowest = 10.0}, {2.0, 3.0});
  EXPECT_EQ(beyond.low, 10.0);
  EXPECT_GT(beyond.high, 10.0);
}

TEST(ChartScale, IsNeverEmpty) {
  for (const std::vector<double>& values :
       {std::vector<double>{}, {0.0}, {5.0}, {-5.0, -5.0}, {1e-300}, {1.0, std::nextafter(1.0, 2.0)}}) {
    const ChartScale scale = scale_of({}, values);
    EXPECT_LT(scale.low, scale.high);
    EXPECT_GE(labels_of(scale).size(), 2U);
  }
  EXPECT_GE(scale_of({.least_span = 0.5}, {1.0, 1.001}).high - scale_of({.least_span = 0.5}, {1.0, 1.001}).low, 0.5);
  EXPECT_GE(labels_of(scale_of({.logarithmic = true}, {})).size(), 2U);
  EXPECT_GE(labels_of(scale_of({.logarithmic = true}, {3.0})).size(), 2U);
}

TEST(ChartScale, LabelsRoundNumbers) {
  EXPECT_EQ(labels_of({.low = 0.0, .high = 6.2}), (Labels{"0", "2", "4", "6"}));
  EXPECT_EQ(labels_of({.low = -0.3, .high = 0.31}), (Labels{"-0.2", "0.0", "0.2"}));
  EXPECT_EQ(labels_of({.low = 0.0, .high = 3e-5}), (Labels{"0", "5e-06", "1e-05", "1.5e-05", "2e-05", "2.5e-05", "3e-05"}));
  EXPECT_EQ(labels_of({.low = 1e-4, .high = 11e-4}), (Labels{"0.0002", "0.0004", "0.0006", "0.0008", "0.0010"}));
}

TEST(ChartScale, LabelsPowersOfTen) {
  EXPECT_EQ(labels_of({.logarithmic = true, .low = -3.2, .high = 1.1}), (Labels{"0.001", "0.01", "0.1", "1", "10"}));
  EXPECT_EQ(labels_of({.logarithmic = true, .low = -12.0, .high = 3.0}).size(), 8U);
}

TEST(ChartScale, LabelsBetweenPowersOfTenWhereFewAreShown) {
  EXPECT_EQ(labels_of({.logarithmic = true, .low = std::log10(0.04), .high = std::log10(0.6)}),
            (Labels{"0.05", "0.1", "0.2", "0.5"}));
  const ChartScale narrow{.logarithmic = true, .low = std::log10(3.0), .high = std::log10(4.0)};
  for (const ChartTick& tick : narrow.ticks()) EXPECT_NEAR(std::pow(10.0, tick.at), std::stod(tick.label), 1e-9);
  EXPECT_GE(labels_of(narrow).size(), 4U);
}

TEST(ChartScale, MakesUnitsEqual) {
  ChartScale x{.low = 0.0, .high = 1.0};
  ChartScale y{.low = 2.0, .high = 6.0};
  make_equal(x, y, 2.0);
  EXPECT_DOUBLE_EQ(y.high - y.low, 4.0);
  EXPECT_DOUBLE_EQ(x.high - x.low, 8.0);
  EXPECT_DOUBLE_EQ(0.5 * (x.low + x.high), 0.5);
}

}  // namespace
}  // namespace menger::io
