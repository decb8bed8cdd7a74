// Air, lines, pistons and compliant plena by themselves.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/pneumatics/pneumatic_line.h"
#include "fem/pneumatics/pneumatic_piston.h"
#include "fem/surfaces/plenum_compliance.h"

namespace menger::fem {
namespace {

TEST(PneumaticGas, FreeAirAndPressureAreInverse) {
  for (const double exponent : {1.0, 1.2, 1.4}) {
    const PneumaticGas gas{exponent, 1e5};
    for (const double pressure : {-9e4, -5e3, 0.0, 1e-3, 6e3, 4e5}) {
      const double air = free_air_m3(gas, pressure, 2e-5);
      EXPECT_NEAR(air_pressure_Pa(gas, air, 2e-5), pressure, 1e-10 + 1e-14 * 1e5);
      EXPECT_NEAR(air, 2e-5 * std::pow(1.0 + pressure / 1e5, 1.0 / exponent), 1e-18);
    }
  }
}

// Energy, pressure and flow energy belong together: dE/dV = -p, dE/dN = h, by central differences, whose error is 1e-8 of the
// value.
TEST(PneumaticGas, EnergyIsThePotentialOfPressureAndFlow) {
  for (const double exponent : {1.0, 1.4}) {
    const PneumaticGas gas{exponent, 1e5};
    const double volume = 3e-5;
    for (const double pressure : {-4e4, 5e3, 2e5}) {
      const double air = free_air_m3(gas, pressure, volume);
      const double h = 1e-4;
      const double by_volume =
          (air_energy_J(gas, air, volume * (1.0 + h)) - air_energy_J(gas, air, volume * (1.0 - h))) / (2.0 * h * volume);
      const double by_air =
          (air_energy_J(gas, air * (1.0 + h), volume) - air_energy_J(gas, air * (1.0 - h), volume)) / (2.0 * h * air);
      EXPECT_NEAR(by_volume, -pressure, 1e-7 * 3e5);
      EXPECT_NEAR(by_air, flow_energy_J_per_m3(gas, pressure), 1e-7 * 3e5);
    }
    EXPECT_EQ(flow_energy_J_per_m3(gas, 0.0), 0.0);
    EXPECT_NEAR(air_energy_J(gas, 1e-5, 1e-5), 0.0, 1e-20);
  }
}

// rho dP = -R rho_ambient dN/dt dx/l, integrated along the tube in 1000 midpoint steps, whose error is 1e-6 of the drop.
TEST(PneumaticLine, FlowIsThatOfHagenAndPoiseuilleInEveryPieceOfTheTube) {
  const PneumaticGas gas{1.0, 1e5};
  const PneumaticLine line = round_line(2.0, {3e-3});
  EXPECT_NEAR(line.resistance_Pa_s_per_m3, 1.83095e7, 1e2);  // 8 mu l / (pi r^4)
  EXPECT_NEAR(line.volume_m3, 1.41372e-5, 1e-10);
  const double from = 8e4;
  const double to = -3e4;
  const double flow = line_drive_Pa(gas, from, to) / line.resistance_Pa_s_per_m3;
  double pressure = from;
  constexpr int pieces = 1000;
  const auto slope = [&](double at) { return -line.resistance_Pa_s_per_m3 * flow / (1.0 + at / 1e5); };
  for (int n = 0; n < pieces; ++n) pressure += slope(pressure + 0.5 * slope(pressure) / pieces) / pieces;
  EXPECT_NEAR(pressure, to, 1e-6 * (from - to));
  EXPECT_NEAR(line_drive_Pa(gas, 1e-3, 0.0), 1e-3, 1e-10);
  EXPECT_EQ(line_drive_Pa(gas, from, to), -line_drive_Pa(gas, to, from));
}

// dP/dx = -f G^2 / (2 rho d) with the friction factor of the mean flow, G = 4 rho_ambient dN/dt / (pi d^2), integrated along the
// tube as above; on both sides of the change of laws.
TEST(PneumaticLine, FrictionFactorIsThatOfLaminarOrTurbulentFlow) {
  const PneumaticGas gas{1.0, 1e5};
  const double ambient_density = air_density_kg_per_m3 * 1e5 / standard_atmosphere_Pa;
  const RoundBore bore{3e-3};
  const PneumaticLine line = round_line(2.0, bore);
  for (const double from : {1e2, 3e3, 2e4}) {
    const double flow = line_flow_m3_per_s(gas, line, from, -500.0);
    const double reynolds = reynolds_number(gas, flow, bore);
    const double factor = std::max(64.0 / reynolds, 0.3164 * std::pow(reynolds, -0.25));
    const double mass_flux = 4.0 * ambient_density * flow / (std::numbers::pi * 9e-6);
    double pressure = from;
    constexpr int pieces = 1000;
    const auto slope = [&](double at) {
      const double density = ambient_density * (1.0 + at / 1e5);
      return -factor * mass_flux * mass_flux / (2.0 * density * 3e-3) * 2.0;
    };
    for (int n = 0; n < pieces; ++n) pressure += slope(pressure + 0.5 * slope(pressure) / pieces) / pieces;
    EXPECT_NEAR(pressure, -500.0, 1e-6 * (from + 500.0)) << reynolds;
  }
  EXPECT_LT(reynolds_number(gas, line_flow_m3_per_s(gas, line, 1e2, -500.0), bore), 1000.0);
  EXPECT_GT(reynolds_number(gas, line_flow_m3_per_s(gas, line, 2e4, -500.0), bore), 4000.0);
}

TEST(PneumaticLine, FlowGrowsWithItsDriveWithoutJumps) {
  const double h = 1e-4;
  double last = 0.0;
  for (const double drive : {0.5, 0.999999, 1.000001, 3.0, 100.0}) {
    const ResistedFlow flow = resisted_flow(drive, 1.0);
    EXPECT_GT(flow.flow_Pa, last);
    EXPECT_EQ(resisted_flow(-drive, 1.0).flow_Pa, -flow.flow_Pa);
    last = flow.flow_Pa;
    if (std::abs(drive - 1.0) < h) continue;
    const double difference = (resisted_flow(drive + h, 1.0).flow_Pa - resisted_flow(drive - h, 1.0).flow_Pa) / (2.0 * h);
    EXPECT_NEAR(flow.by_drive, difference, 1e-8);
  }
  EXPECT_NEAR(resisted_flow(1.000001, 1.0).flow_Pa, 1.0, 1e-6);
  EXPECT_NEAR(round_line_of(2.0, round_line(2.0, {3e-3}).resistance_Pa_s_per_m3).bore->diameter_m, 3e-3, 1e-15);
}

TEST(PneumaticLine, ReynoldsNumberIsThatOfTheMeanSpeed) {
  const double diameter = 4e-3;
  const double flow = 1e-4;
  const double speed = flow / (std::numbers::pi * 0.25 * diameter * diameter);
  EXPECT_NEAR(reynolds_number({}, flow, {diameter}), air_density_kg_per_m3 * speed * diameter / air_viscosity_Pa_s, 1e-9);
  EXPECT_EQ(reynolds_number({}, -flow, {diameter}), reynolds_number({}, flow, {diameter}));
}

TEST(Piston, SweepsItsStrokeAndStartsWithdrawn) {
  const Piston piston{
      .name = "cam", .bore_m = 0.04, .cylinder_length_m = 0.1, .stroke_m = 0.06, .dead_volume_m3 = 2e-6, .frequency_Hz = 2.0};
  const double area = std::numbers::pi * 4e-4;
  EXPECT_NEAR(cylinder_volume_m3(piston, 0.0), 2e-6 + 0.1 * area, 1e-18);
  EXPECT_NEAR(cylinder_volume_m3(piston, 0.25), 2e-6 + 0.04 * area, 1e-18);
  EXPECT_NEAR(cylinder_volume_m3(piston, 0.125), 2e-6 + 0.07 * area, 1e-18);
  EXPECT_NEAR(cylinder_volume_m3(piston, 7.1), cylinder_volume_m3(piston, 0.1), 1e-17);
  EXPECT_NEAR(swept_volume_m3(piston), 0.06 * area, 1e-18);
}

TEST(Piston, RampBeginsWithdrawnAtAnyPhase) {
  Piston piston{.name = "cam", .bore_m = 0.04, .cylinder_length_m = 0.1, .stroke_m = 0.06, .frequency_Hz = 2.0, .phase = 0.5};
  const double area = std::numbers::pi * 4e-4;
  EXPECT_NEAR(cylinder_volume_m3(piston, 0.0), 0.04 * area, 1e-18);
  piston.ramp_s = 1.0;
  EXPECT_NEAR(cylinder_volume_m3(piston, 0.0), 0.1 * area, 1e-18);
  EXPECT_NEAR(cylinder_volume_m3(piston, 0.5), 0.07 * area, 1e-18);
  EXPECT_NEAR(cylinder_volume_m3(piston, 1.5), 0.04 * area, 1e-18);
}

TEST(PlenumCompliance, IsInterpolatedAndHeldAtItsEnds) {
  const PlenumCompliance plenum{{-1e3, 0.0, 2e3}, {1e-5, 2e-5, 6e-5}};
  EXPECT_DOUBLE_EQ(plenum.volume_m3(1e3), 4e-5);
  EXPECT_DOUBLE_EQ(plenum.volume_m3(-2e3), 1e-5);
  EXPECT_DOUBLE_EQ(plenum.volume_m3(3e3), 6e-5);
  EXPECT_DOUBLE_EQ(plenum.derivative_m3_per_Pa(-500.0), 1e-8);
  EXPECT_DOUBLE_EQ(plenum.derivative_m3_per_Pa(500.0), 2e-8);
  EXPECT_EQ(plenum.derivative_m3_per_Pa(-2e3), 0.0);
  EXPECT_EQ(plenum.derivative_m3_per_Pa(2e3), 0.0);
  EXPECT_TRUE(plenum.contains(2e3));
  EXPECT_FALSE(plenum.contains(2001.0));
}

}  // namespace
}  // namespace menger::fem
