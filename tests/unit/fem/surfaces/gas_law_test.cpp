#include "fem/surfaces/gas_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace menger::fem {
namespace {

constexpr GasLaw isothermal{.reference_pressure_Pa = 0.0, .reference_volume_m3 = 4e-6};
constexpr GasLaw adiabatic{.exponent = 1.4, .reference_pressure_Pa = 3000.0, .reference_volume_m3 = 4e-6};

TEST(GasLaw, FollowsBoyle) {
  EXPECT_NEAR(gas_volume(isothermal, 101325.0)->volume_m3, 2e-6, 1e-20);
  EXPECT_NEAR(*gas_pressure_Pa(isothermal, 8e-6), -0.5 * 101325.0, 1e-9);
  EXPECT_EQ(gas_volume(isothermal, 0.0)->volume_m3, 4e-6);
  EXPECT_EQ(gas_pressure_Pa(isothermal, 4e-6), 0.0);
}

TEST(GasLaw, KeepsPressureTimesPowerOfVolume) {
  const double constant = (3000.0 + 101325.0) * std::pow(4e-6, 1.4);
  for (const double p : {-90000.0, -2000.0, 0.0, 6000.0, 200000.0}) {
    const double volume = gas_volume(adiabatic, p)->volume_m3;
    EXPECT_NEAR((p + 101325.0) * std::pow(volume, 1.4), constant, 1e-14 * constant);
    EXPECT_NEAR(*gas_pressure_Pa(adiabatic, volume), p, 1e-10 * 101325.0);
  }
}

/// A gauge pressure of 1e-6 Pa is 1e-11 of the ambient one; as a difference of absolute pressures it would be good to 1e-5 only.
TEST(GasLaw, KeepsSmallGaugePressures) {
  const double volume = 4e-6 * (1.0 - 1e-11);
  const double shrink = (4e-6 - volume) / 4e-6;  // as it was stored
  const double expected = 101325.0 * shrink / (1.0 - shrink);
  EXPECT_NEAR(*gas_pressure_Pa(isothermal, volume), expected, 1e-12 * expected);
}

TEST(GasLaw, TwiceTheAmountTakesTwiceTheVolume) {
  for (GasLaw gas : {isothermal, adiabatic}) {
    const double volume = gas_volume(gas, 5000.0)->volume_m3;
    const double derivative = gas_volume(gas, 5000.0)->derivative_m3_per_Pa;
    gas.amount = 2.0;
    EXPECT_NEAR(gas_volume(gas, 5000.0)->volume_m3, 2.0 * volume, 1e-20);
    EXPECT_NEAR(gas_volume(gas, 5000.0)->derivative_m3_per_Pa, 2.0 * derivative, 1e-25);
    EXPECT_NEAR(*gas_pressure_Pa(gas, 2.0 * volume), 5000.0, 1e-9);
  }
  // In the same volume an isothermal gas doubles its absolute pressure.
  GasLaw doubled = isothermal;
  doubled.amount = 2.0;
  EXPECT_NEAR(*gas_pressure_Pa(doubled, 4e-6), 101325.0, 1e-9);
}

/// Central differences with h = 1 Pa: truncation h^2/P^2 ~ 1e-10, rounding 1e-16 P/h ~ 1e-11.
TEST(GasLaw, DerivativeMatchesDifferences) {
  for (const GasLaw& gas : {isothermal, adiabatic}) {
    for (const double p : {-50000.0, 0.0, 6000.0}) {
      const double difference = (gas_volume(gas, p + 1.0)->volume_m3 - gas_volume(gas, p - 1.0)->volume_m3) / 2.0;
      EXPECT_NEAR(gas_volume(gas, p)->derivative_m3_per_Pa, difference, 1e-8 * std::abs(difference));
    }
  }
}

/// The work against Simpson's rule over p(V), whose error with 1000 intervals is below 1e-12 of the work here.
TEST(GasLaw, WorkIsTheIntegralOfGaugePressure) {
  for (const double exponent : {0.5, 1.0, 1.0 + 1e-9, 1.4}) {
    GasLaw gas = adiabatic;
    gas.exponent = exponent;
    gas.amount = 1.3;
    const double from = 3e-6;
    const double to = 7e-6;
    const int intervals = 1000;
    const double h = (to - from) / intervals;
    double integral = 0.0;
    for (int i = 0; i <= intervals; ++i) {
      const double weight = i == 0 || i == intervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
      integral += weight * h / 3.0 * *gas_pressure_Pa(gas, from + i * h);
    }
    EXPECT_NEAR(gas_work_J(gas, from, to), integral, 1e-10 * std::abs(integral)) << exponent;
    EXPECT_NEAR(gas_work_J(gas, to, from), -integral, 1e-10 * std::abs(integral)) << exponent;
  }
  EXPECT_NEAR(gas_work_J(isothermal, 4e-6, 8e-6), 101325.0 * 4e-6 * (std::log(2.0) - 1.0), 1e-15);
}

TEST(GasLaw, HasNoVolumeWithoutAbsolutePressure) {
  EXPECT_FALSE(gas_volume(isothermal, -101325.0));
  EXPECT_FALSE(gas_volume(isothermal, -2e5));
  EXPECT_FALSE(gas_volume(isothermal, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(gas_pressure_Pa(isothermal, 0.0));
  EXPECT_FALSE(gas_pressure_Pa(isothermal, -1e-6));
  EXPECT_FALSE(plenum_closure(isothermal, -2e5, 1e-6));
}

TEST(GasLaw, KnowsItsValidParameters) {
  EXPECT_TRUE(is_valid(GasLaw{}));
  EXPECT_TRUE(is_valid({.ambient_pressure_Pa = 0.0, .reference_pressure_Pa = 1.0}));
  EXPECT_FALSE(is_valid({.exponent = 0.0}));
  EXPECT_FALSE(is_valid({.exponent = std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_FALSE(is_valid({.ambient_pressure_Pa = -1.0}));
  EXPECT_FALSE(is_valid({.reference_pressure_Pa = -101325.0}));
  EXPECT_FALSE(is_valid({.reference_volume_m3 = 0.0}));
  EXPECT_FALSE(is_valid({.amount = -1.0}));
}

TEST(PlenumClosure, VanishesAtTheStateItAsksFor) {
  const double volume = gas_volume(adiabatic, 6000.0)->volume_m3;
  EXPECT_EQ(plenum_closure(PressureControl{6000.0}, 6000.0, 1.0)->residual, 0.0);
  EXPECT_EQ(plenum_closure(VolumeControl{2e-6}, 1.0, 2e-6)->residual, 0.0);
  EXPECT_EQ(plenum_closure(adiabatic, 6000.0, volume)->residual, 0.0);
  EXPECT_EQ(plenum_closure(PressureControl{6000.0}, 6001.0, 1.0)->residual, 1.0);
  EXPECT_GT(plenum_closure(adiabatic, 6000.0, 1.1 * volume)->residual, 0.0);
}

TEST(PlenumClosure, DerivativesMatchDifferences) {
  for (const PlenumControl& control :
       {PlenumControl{PressureControl{6000.0}}, PlenumControl{VolumeControl{2e-6}}, PlenumControl{adiabatic}}) {
    const double p = 4000.0;
    const double volume = 3e-6;
    const auto closure = plenum_closure(control, p, volume);
    const double by_pressure =
        (plenum_closure(control, p + 1.0, volume)->residual - plenum_closure(control, p - 1.0, volume)->residual) / 2.0;
    // as for the derivative of the volume above
    EXPECT_NEAR(closure->by_pressure, by_pressure, 1e-8 * std::abs(by_pressure));
  }
}

}  // namespace
}  // namespace menger::fem
