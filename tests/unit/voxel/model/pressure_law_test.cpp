#include "voxel/model/pressure_law.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace menger::voxel
