// Air between supplies and plena: amounts, works and what a supply refuses.

#include "fem/pneumatics/pneumatic_supply.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/input_error_message.h"

namespace menger::fem {
namespace {

constexpr double tau = 2.0 * std::numbers::pi;

/// Three plena: two on a piston through lines of their own, one behind a source.
PneumaticSupply mixed_supply(double exponent) {
  const Piston piston{.name = "cam",
                      .bore_m = 0.03,
                      .cylinder_length_m = 0.05,
                      .stroke_m = 0.04,
                      .dead_volume_m3 = 2e-6,
                      .frequency_Hz = 1.2,
                      .fill_pressure_Pa = 500.0};
  return PneumaticSupply(
      {PistonSupply{0, {2e7, 3e-6}}, LineSupply{{SinePressure{.high_Pa = 2e4, .frequency_Hz = 2.0}}, {1e7, 1e-6}},
       PistonSupply{0, {0.0, 1e-6}}},
      {piston}, {.exponent = exponent});
}

/// Plena that breathe by themselves.
std::vector<double> breathing_m3(double time_s) {
  return {4e-5 + 1e-5 * std::sin(tau * 1.7 * time_s), 2e-5 * (1.0 + 0.2 * time_s), 3e-5 - 5e-6 * std::sin(tau * 0.9 * time_s)};
}

PneumaticState after(const PneumaticSupply& supply, double end_s, int steps) {
  PneumaticState state = supply.start(0.0, breathing_m3(0.0));
  for (int n = 1; n <= steps; ++n) EXPECT_TRUE(supply.advance(state, end_s * n / steps, breathing_m3(end_s * n / steps)));
  return state;
}

TEST(PneumaticSupply, AirIsConserved) {
  for (const double exponent : {1.0, 1.4}) {
    const PneumaticSupply supply = mixed_supply(exponent);
    const double air = supply.free_air_m3(supply.start(0.0, breathing_m3(0.0)));
    // Each of 10 000 steps rounds four amounts; errors add up as in a random walk to about 100 units of the last place.
    EXPECT_NEAR(supply.free_air_m3(after(supply, 2.0, 10000)), air, 1e-13 * air);
  }
}

/// What the energy of all air misses, over the work of the piston.
double open_books(const PneumaticSupply& supply, int steps) {
  const double at_start = supply.stored_J(supply.start(0.0, breathing_m3(0.0)));
  const PneumaticState end = after(supply, 1.1, steps);
  EXPECT_GT(end.work.piston_J, 0.01);
  EXPECT_GT(end.work.line_J, 1e-3);
  const double given = end.work.piston_J + end.work.source_J - end.work.plenum_J - end.work.line_J;
  return std::abs(supply.stored_J(end) - at_start - given) / end.work.piston_J;
}

TEST(PneumaticSupply, EnergyBooksCloseWithTheSquareOfTheStep) {
  for (const double exponent : {1.0, 1.4}) {
    const PneumaticSupply supply = mixed_supply(exponent);
    const double coarse = open_books(supply, 400);
    const double fine = open_books(supply, 800);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15) << coarse << " " << fine;
  }
}

TEST(PneumaticSupply, StepIsOfSecondOrder) {
  const PneumaticSupply supply = mixed_supply(1.4);
  std::vector<std::vector<double>> pressures;
  for (const int steps : {800, 1600, 3200}) pressures.push_back(supply.pressures_Pa(after(supply, 1.1, steps)));
  for (std::size_t j = 0; j < 3; ++j) {
    const double order = std::log2((pressures[0][j] - pressures[1][j]) / (pressures[1][j] - pressures[2][j]));
    EXPECT_NEAR(order, 2.0, 0.1) << "plenum " << j;
  }
}

// Lines from hardly any resistance to none: at the end of a step of many time constants all pressures are equal, and what is left
// falls with the resistance.
TEST(PneumaticSupply, LinesWithoutResistanceJoinTheirEnds) {
  const Piston piston{.name = "cam", .bore_m = 0.03, .cylinder_length_m = 0.05, .stroke_m = 0.04, .frequency_Hz = 1.0};
  const auto difference = [&](double resistance) {
    const PneumaticSupply supply({PistonSupply{0, {resistance, 2e-6}}}, {piston});
    PneumaticState state = supply.start(0.0, std::vector<double>{4e-5});
    for (int n = 1; n <= 25; ++n) EXPECT_TRUE(supply.advance(state, 0.01 * n, std::vector<double>{4e-5}));
    return supply.piston_pressure_Pa(state, 0) - supply.pressure_Pa(state, 0);
  };
  EXPECT_NEAR(difference(0.0), 0.0, 1e-9);  // rounding of 1e5 Pa
  EXPECT_LT(std::abs(difference(1e-6)), 1e-8);
  EXPECT_NEAR(difference(1e4) / difference(1e3), 10.0, 0.1);
}

// A source that jumps by 50 kPa before a short line and steps of a thousand time constants.
TEST(PneumaticSupply, ShortLinesDoNotLimitTheStep) {
  const PneumaticSupply supply({LineSupply{{ConstantPressure{5e4}}, {1e3, 0.0}}});  // R V / P = 4e-7 s
  PneumaticState state = supply.start(0.0, std::vector<double>{4e-5});
  EXPECT_EQ(supply.pressure_Pa(state, 0), 0.0);
  double last = 5e4;
  for (int n = 1; n <= 5; ++n) {
    ASSERT_TRUE(supply.advance(state, 4e-4 * n, std::vector<double>{4e-5}));
    EXPECT_LE(std::abs(supply.pressure_Pa(state, 0) - 5e4), last);
    last = 0.1 * std::abs(supply.pressure_Pa(state, 0) - 5e4) + 1e-8;
  }
}

TEST(PneumaticSupply, StateCanBeTakenUpAgain) {
  const PneumaticSupply supply = mixed_supply(1.4);
  PneumaticState first = after(supply, 0.5, 100);
  PneumaticState second = first;
  const PneumaticSupply copy = supply;
  ASSERT_TRUE(supply.advance(first, 0.6, breathing_m3(0.6)));
  ASSERT_TRUE(copy.advance(second, 0.6, breathing_m3(0.6)));
  EXPECT_EQ(first.plenum_air_m3, second.plenum_air_m3);
  EXPECT_EQ(first.piston_air_m3, second.piston_air_m3);
  EXPECT_EQ(first.work.line_J, second.work.line_J);
}

TEST(PneumaticSupply, RefusesVolumesThatAreNone) {
  const PneumaticSupply supply = mixed_supply(1.0);
  PneumaticState state = supply.start(0.0, breathing_m3(0.0));
  const PneumaticState before = state;
  EXPECT_FALSE(supply.advance(state, 0.01, std::vector<double>{4e-5, -1e-6, 3e-5}));
  EXPECT_FALSE(supply.advance(state, 0.01, std::vector<double>{4e-5, std::nan(""), 3e-5}));
  EXPECT_EQ(state.time_s, 0.0);
  EXPECT_EQ(state.plenum_air_m3, before.plenum_air_m3);
}

// Plena that follow their pressure: the same air as in the rigid volume that they come to.
TEST(PneumaticSupply, CompliantPlenumTakesTheVolumeOfItsPressure) {
  const Piston piston{.name = "cam", .bore_m = 0.04, .cylinder_length_m = 0.05, .stroke_m = 0.04, .frequency_Hz = 1.0};
  const PneumaticSupply supply({PistonSupply{0, {0.0, 2e-6}}}, {piston});
  const std::vector<PlenumCompliance> plena{{{-1e4, 0.0, 1e4, 3e4}, {3e-5, 4e-5, 6e-5, 9e-5}}};
  PneumaticState state = supply.start(0.0, std::vector<double>{4e-5});
  for (int n = 1; n <= 50; ++n) ASSERT_TRUE(supply.advance(state, 0.01 * n, plena));
  const double pressure = supply.pressure_Pa(state, 0);
  EXPECT_GT(pressure, 1e4);
  EXPECT_NEAR(state.volumes_m3[0], plena[0].volume_m3(pressure), 1e-15);
  const double volume = cylinder_volume_m3(piston, 0.5) + 2e-6 + state.volumes_m3[0];
  const double at_start = cylinder_volume_m3(piston, 0.0) + 2e-6 + 4e-5;
  EXPECT_NEAR((standard_atmosphere_Pa + pressure) * volume, standard_atmosphere_Pa * at_start, 1e-9 * at_start * 1e5);
}

TEST(PneumaticSupply, StepsMustResolvePistonsAndSources) {
  const PneumaticSupply supply = mixed_supply(1.0);
  const std::vector<std::string> plena{"a", "b", "c"};
  EXPECT_EQ(tests::message_of([&] { supply.check_resolved(plena, 0.02); }), "no error");
  EXPECT_NE(tests::message_of([&] { supply.check_resolved(plena, 0.03); }).find("plenum \"b\": a period of 0.5"),
            std::string::npos);
  const PneumaticSupply alone({PistonSupply{0, {}}}, {{.name = "cam", .frequency_Hz = 4.0}});
  EXPECT_NE(tests::message_of([&] {
              alone.check_resolved(std::vector<std::string>{"a"}, 0.02);
            }).find("piston \"cam\": a period of 0.25 s"),
            std::string::npos);
  const PneumaticSupply ramped({PistonSupply{0, {}}}, {{.name = "cam", .frequency_Hz = 1.0, .ramp_s = 0.03}});
  EXPECT_NE(tests::message_of([&] {
              ramped.check_resolved(std::vector<std::string>{"a"}, 0.02);
            }).find("piston \"cam\": a ramp of 0.03"),
            std::string::npos);
}

}  // namespace
}  // namespace menger::fem
