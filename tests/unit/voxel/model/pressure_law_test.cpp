#include "voxel/model/pressure_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "voxel/model/law_extremes.h"

namespace menger::voxel {
namespace {

TEST(PressureLaw, BendsPlatesUnderPressureAndNotWithoutEnd) {
  const PressureLaw law{.arc = -0.2, .arc_per_Pa = 1e-3};
  EXPECT_EQ(law.value(0.0), 0.0);
  EXPECT_EQ(law.derivative(0.0), 0.0);
  EXPECT_DOUBLE_EQ(law.value(1000.0), -0.1) << "half of it at the reciprocal";
  EXPECT_EQ(law.value(-1000.0), 0.0);
  EXPECT_NEAR(law.value(1e9), -0.2, 1e-12);
  EXPECT_DOUBLE_EQ(law.value(1e200), -0.2);
  // For small bulges as the arc of a wall: with the square of the pressure.
  EXPECT_NEAR(law.value(1.0) / law.value(0.5), 4.0, 1e-5);
}

TEST(PressureLaw, HasItsDerivative) {
  const PressureLaw law{.slope_per_Pa = 2e-6,
                        .pressure_softening_per_Pa = 1e-5,
                        .vacuum_softening_per_Pa = -2e-5,
                        .fading_share = 0.4,
                        .fading_per_Pa = 3e-4,
                        .arc = -0.2,
                        .arc_per_Pa = 5e-4};
  for (const double pressure_Pa : {-3000.0, -100.0, 200.0, 2000.0, 9000.0}) {
    constexpr double step_Pa = 0.1;
    const double difference = (law.value(pressure_Pa + step_Pa) - law.value(pressure_Pa - step_Pa)) / (2.0 * step_Pa);
    EXPECT_NEAR(law.derivative(pressure_Pa), difference, 1e-10) << pressure_Pa;  // rounding: 1e-16 / 0.1 Pa, and far more room
  }
}

TEST(PressureLaw, WithoutArcsHasTheBytesOfTheRest) {
  const PressureLaw plain{.slope_per_Pa = 2e-6, .pressure_softening_per_Pa = 1e-5};
  PressureLaw other = plain;
  other.arc_per_Pa = 1e-3;
  EXPECT_EQ(plain.value(1234.5), other.value(1234.5));
  EXPECT_EQ(plain.derivative(1234.5), other.derivative(1234.5));
}

constexpr double lowest_pressure_Pa = -2e3, highest_pressure_Pa = 1e4;

struct LawValues {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();

  void take(double value) {
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
  }
};

LawValues scanned(const PressureLaw& law) {
  LawValues values;
  constexpr int count = 120000;
  for (int i = 0; i <= count; ++i)
    values.take(law.value(lowest_pressure_Pa + (highest_pressure_Pa - lowest_pressure_Pa) * i / count));
  return values;
}

LawValues at_extreme_pressures(const PressureLaw& law) {
  LawValues values;
  for (const double pressure_Pa : extreme_pressures(law, lowest_pressure_Pa, highest_pressure_Pa)) {
    EXPECT_GE(pressure_Pa, lowest_pressure_Pa);
    EXPECT_LE(pressure_Pa, highest_pressure_Pa);
    values.take(law.value(pressure_Pa));
  }
  return values;
}

TEST(PressureLaw, HasItsExtremesAtTheirPressures) {
  int inside = 0;
  for (const double slope : {-3e-5, -1e-6, 1e-7, 1e-5, 3e-5, 2e-4}) {
    for (const double arc : {-0.95, -0.15, 0.3}) {
      for (const double arc_per_Pa : {1e-6, 1e-4, 4e-4, 1e-2}) {
        for (const double softening : {-3e-4, 0.0, 9e-5}) {
          for (const double share : {0.0, 0.4, 1.0}) {
            const PressureLaw law{.slope_per_Pa = slope,
                                  .pressure_softening_per_Pa = softening,
                                  .vacuum_softening_per_Pa = 1e-4,
                                  .fading_share = share,
                                  .fading_per_Pa = 5e-4,
                                  .arc = arc,
                                  .arc_per_Pa = arc_per_Pa};
            const LawValues scan = scanned(law);
            const LawValues extremes = at_extreme_pressures(law);
            // Between two points of the scan the law moves by less than its slope times their distance, squared near an extreme.
            EXPECT_LE(extremes.smallest, scan.smallest + 1e-14);
            EXPECT_GE(extremes.largest, scan.largest - 1e-14);
            EXPECT_NEAR(extremes.smallest, scan.smallest, 1e-5);
            EXPECT_NEAR(extremes.largest, scan.largest, 1e-5);
            if (scan.smallest < std::min(law.value(lowest_pressure_Pa), law.value(highest_pressure_Pa)) - 1e-4) ++inside;
            if (scan.largest > std::max(law.value(lowest_pressure_Pa), law.value(highest_pressure_Pa)) + 1e-4) ++inside;
          }
        }
      }
    }
  }
  EXPECT_GT(inside, 30) << "of these laws many have an extreme inside";
}

TEST(PressureLaw, WithoutArcsAgainstItsSlopeIsMonotone) {
  const PressureLaw plain{.slope_per_Pa = 2e-6, .pressure_softening_per_Pa = 1e-5, .fading_share = 0.5, .fading_per_Pa = 1e-3};
  PressureLaw rising = plain;
  rising.arc = 0.3;
  rising.arc_per_Pa = 1e-3;
  for (const PressureLaw& law : {plain, rising, PressureLaw{}})
    EXPECT_EQ(extreme_pressures(law, -1e3, 2e3), (std::vector<double>{-1e3, 2e3}));
  EXPECT_EQ(extreme_pressures({.slope_per_Pa = 2e-6, .arc = -0.3, .arc_per_Pa = 1e-3}, -1e3, 0.0).size(), 2U) << "vacuum";
}

TEST(PressureLaw, KeepsAPlateLongerThanItsDrawIn) {
  // A plate that stretches is shortest inside the range of pressures; a length is left there at any draw-in below 1.
  for (const double slope : {0.0, 1e-12, 1e-7, 1e-5, 1e-3}) {
    const PressureLaw law{.slope_per_Pa = slope, .vacuum_softening_per_Pa = 1e-4, .arc = -0.999, .arc_per_Pa = 1.0};
    constexpr int count = 10000;
    for (int i = 0; i <= count; ++i) EXPECT_GE(law.value(highest_pressure_Pa * i / count), law.arc) << slope << " " << i;
  }
}

}  // namespace
}  // namespace menger::voxel
