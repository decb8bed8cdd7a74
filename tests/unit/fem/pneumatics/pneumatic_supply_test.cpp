// Air between supplies and plena: amounts, works and what a supply refuses.

#include "fem/pneumatics/pneumatic_supply.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fem/pneumatics/pneumatic_integrator.h"
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
  PneumaticIntegrator air(supply);
  PneumaticState state = supply.start(0.0, breathing_m3(0.0));
  for (int n = 1; n <= steps; ++n)
    EXPECT_EQ(air.advance(state, end_s * n / steps, breathing_m3(end_s * n / steps)).status, io::RunStatus::completed);
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
double open_balance(const PneumaticSupply& supply, int steps) {
  const double at_start = supply.stored_J(supply.start(0.0, breathing_m3(0.0)));
  const PneumaticState end = after(supply, 1.1, steps);
  EXPECT_GT(end.work.piston_J, 0.01);
  EXPECT_GT(end.work.line_J, 1e-3);
  const double given = end.work.piston_J + end.work.source_J - end.work.plenum_J - end.work.line_J;
  return std::abs(supply.stored_J(end) - at_start - given) / end.work.piston_J;
}

// Works are integrated along with the air, whatever the steps of the caller.
TEST(PneumaticSupply, EnergyBooksClose) {
  for (const double exponent : {1.0, 1.4}) {
    const PneumaticSupply supply = mixed_supply(exponent);
    EXPECT_LT(open_balance(supply, 400), 1e-6);
    EXPECT_LT(open_balance(supply, 800), 1e-6);
  }
}

// Volumes that change in straight lines between the steps of the caller miss their course by the square of the step.
TEST(PneumaticSupply, CoupledStepIsOfSecondOrder) {
  const PneumaticSupply supply = mixed_supply(1.4);
  std::vector<std::vector<double>> pressures;
  for (const int steps : {800, 1600, 3200}) pressures.push_back(supply.pressures_Pa(after(supply, 1.1, steps)));
  for (const std::size_t j : {std::size_t{0}, std::size_t{2}}) {  // the volume of the other changes evenly
    const double order = std::log2((pressures[0][j] - pressures[1][j]) / (pressures[1][j] - pressures[2][j]));
    EXPECT_NEAR(order, 2.0, 0.1) << "plenum " << j;
  }
}

/// The highest pressures of piston and plenum that an observer is told in a period, and when.
struct Peaks {
  double piston_Pa = 0.0;
  double piston_s = 0.0;
  double plenum_Pa = 0.0;
  double plenum_s = 0.0;
};

Peaks peaks_of(const PneumaticSupply& supply, const PlenumCompliance& plenum, const PneumaticAccuracy& accuracy) {
  PneumaticIntegrator air(supply, accuracy);
  PneumaticState state = supply.start(0.0, std::vector<double>{plenum.volume_m3(0.0)});
  Peaks peaks;
  const auto look = [&](const PneumaticState& now) {
    if (supply.piston_pressure_Pa(now, 0) > peaks.piston_Pa) {
      peaks.piston_Pa = supply.piston_pressure_Pa(now, 0);
      peaks.piston_s = now.time_s;
    }
    if (supply.pressure_Pa(now, 0) > peaks.plenum_Pa) {
      peaks.plenum_Pa = supply.pressure_Pa(now, 0);
      peaks.plenum_s = now.time_s;
    }
    return true;
  };
  EXPECT_EQ(air.advance(state, 1.0, std::vector{plenum}, look).status, io::RunStatus::completed);
  return peaks;
}

// Without resistance both pressures turn with the piston, at half a period: steps of a seventh of it never end there.
TEST(PneumaticSupply, TurningPointsAreFoundBetweenSteps) {
  const Piston piston{.name = "cam", .bore_m = 0.03, .cylinder_length_m = 0.05, .stroke_m = 0.04, .frequency_Hz = 1.0};
  const PneumaticSupply supply({PistonSupply{0, {0.0, 2e-6}}}, {piston});
  const Peaks peaks = peaks_of(supply, {{0.0}, {4e-5}}, {.largest_step_s = 1.0 / 7.0});
  const double volume = cylinder_volume_m3(piston, 0.0) + 4.2e-5;
  const double exact = standard_atmosphere_Pa * (volume / (volume - swept_volume_m3(piston)) - 1.0);
  EXPECT_NEAR(peaks.piston_s, 0.5, 1e-9);
  EXPECT_NEAR(peaks.piston_Pa, exact, 1e-9 * exact);
  EXPECT_NEAR(peaks.plenum_Pa, exact, 1e-9 * exact);
}

// Behind a line the plenum turns later than the piston; the same points are found with steps a hundred times shorter.
TEST(PneumaticSupply, TurningPointsDoNotDependOnTheSteps) {
  const Piston piston{.name = "cam", .bore_m = 0.03, .cylinder_length_m = 0.05, .stroke_m = 0.04, .frequency_Hz = 1.0};
  const PneumaticSupply supply({PistonSupply{0, {1e8, 2e-6}}}, {piston});
  const PlenumCompliance plenum{{-2e4, 0.0, 5e3, 4e4}, {3e-5, 4e-5, 5e-5, 8e-5}};
  const Peaks coarse = peaks_of(supply, plenum, {.tolerance = 1e-7, .with_works = false});
  const Peaks fine = peaks_of(supply, plenum, {.tolerance = 1e-11, .largest_step_s = 1e-3});
  EXPECT_GT(fine.plenum_s, fine.piston_s + 0.01);
  EXPECT_NEAR(coarse.piston_s, fine.piston_s, 1e-4);
  EXPECT_NEAR(coarse.plenum_s, fine.plenum_s, 1e-4);
  EXPECT_NEAR(coarse.piston_Pa, fine.piston_Pa, 1e-6 * standard_atmosphere_Pa);
  EXPECT_NEAR(coarse.plenum_Pa, fine.plenum_Pa, 1e-6 * standard_atmosphere_Pa);
}

// The integrator starts anew with each advance: one that has run before gives the bytes of one that has not.
TEST(PneumaticSupply, IntegratorsResumeWithEqualBytes) {
  const PneumaticSupply supply = mixed_supply(1.4);
  PneumaticIntegrator used(supply);
  PneumaticState state = supply.start(0.0, breathing_m3(0.0));
  for (int n = 1; n <= 50; ++n)
    ASSERT_EQ(used.advance(state, 0.002 * n, breathing_m3(0.002 * n)).status, io::RunStatus::completed);
  PneumaticState resumed = state;
  for (int n = 51; n <= 60; ++n) {
    ASSERT_EQ(used.advance(state, 0.002 * n, breathing_m3(0.002 * n)).status, io::RunStatus::completed);
    ASSERT_EQ(PneumaticIntegrator(supply).advance(resumed, 0.002 * n, breathing_m3(0.002 * n)).status, io::RunStatus::completed);
    ASSERT_EQ(state.plenum_air_m3, resumed.plenum_air_m3);
    ASSERT_EQ(state.piston_air_m3, resumed.piston_air_m3);
    ASSERT_EQ(state.work.line_J, resumed.work.line_J);
  }
}

// Lines from hardly any resistance to none: at the end of a step of many time constants all pressures are equal, and what is left
// falls with the resistance.
TEST(PneumaticSupply, LinesWithoutResistanceJoinTheirEnds) {
  const Piston piston{.name = "cam", .bore_m = 0.03, .cylinder_length_m = 0.05, .stroke_m = 0.04, .frequency_Hz = 1.0};
  const auto difference = [&](double resistance) {
    const PneumaticSupply supply({PistonSupply{0, {resistance, 2e-6}}}, {piston});
    PneumaticIntegrator air(supply);
    PneumaticState state = supply.start(0.0, std::vector<double>{4e-5});
    for (int n = 1; n <= 25; ++n)
      EXPECT_EQ(air.advance(state, 0.01 * n, std::vector<double>{4e-5}).status, io::RunStatus::completed);
    return supply.piston_pressure_Pa(state, 0) - supply.pressure_Pa(state, 0);
  };
  EXPECT_NEAR(difference(0.0), 0.0, 1e-9);  // rounding of 1e5 Pa
  EXPECT_LT(std::abs(difference(1e-6)), 1e-8);
  EXPECT_NEAR(difference(1e4) / difference(1e3), 10.0, 0.1);
}

// A source that jumps by 50 kPa before a short line and steps of a thousand time constants.
TEST(PneumaticSupply, ShortLinesDoNotLimitTheStep) {
  const PneumaticSupply supply({LineSupply{{ConstantPressure{5e4}}, {1e3, 0.0}}});  // R V / P = 4e-7 s
  PneumaticIntegrator air(supply);
  PneumaticState state = supply.start(0.0, std::vector<double>{4e-5});
  EXPECT_EQ(supply.pressure_Pa(state, 0), 0.0);
  double last = 5e4;
  for (int n = 1; n <= 5; ++n) {
    ASSERT_EQ(air.advance(state, 4e-4 * n, std::vector<double>{4e-5}).status, io::RunStatus::completed);
    EXPECT_LE(std::abs(supply.pressure_Pa(state, 0) - 5e4), last);
    last = 0.1 * std::abs(supply.pressure_Pa(state, 0) - 5e4) + 1e-8;
  }
}

TEST(PneumaticSupply, StateCanBeTakenUpAgain) {
  const PneumaticSupply supply = mixed_supply(1.4);
  PneumaticState first = after(supply, 0.5, 100);
  PneumaticState second = first;
  const PneumaticSupply copy = supply;
  ASSERT_EQ(PneumaticIntegrator(supply).advance(first, 0.6, breathing_m3(0.6)).status, io::RunStatus::completed);
  ASSERT_EQ(PneumaticIntegrator(copy).advance(second, 0.6, breathing_m3(0.6)).status, io::RunStatus::completed);
  EXPECT_EQ(first.plenum_air_m3, second.plenum_air_m3);
  EXPECT_EQ(first.piston_air_m3, second.piston_air_m3);
  EXPECT_EQ(first.work.line_J, second.work.line_J);
}

TEST(PneumaticSupply, RefusesVolumesThatAreNone) {
  const PneumaticSupply supply = mixed_supply(1.0);
  PneumaticState state = supply.start(0.0, breathing_m3(0.0));
  const PneumaticState before = state;
  PneumaticIntegrator air(supply);
  EXPECT_EQ(air.advance(state, 0.01, std::vector<double>{4e-5, -1e-6, 3e-5}).status, io::RunStatus::diverged);
  EXPECT_EQ(air.advance(state, 0.01, std::vector<double>{4e-5, std::nan(""), 3e-5}).status, io::RunStatus::diverged);
  EXPECT_EQ(state.time_s, 0.0);
  EXPECT_EQ(state.plenum_air_m3, before.plenum_air_m3);
}

// Plena that follow their pressure: the same air as in the rigid volume that they come to.
TEST(PneumaticSupply, CompliantPlenumTakesTheVolumeOfItsPressure) {
  const Piston piston{.name = "cam", .bore_m = 0.04, .cylinder_length_m = 0.05, .stroke_m = 0.04, .frequency_Hz = 1.0};
  const PneumaticSupply supply({PistonSupply{0, {0.0, 2e-6}}}, {piston});
  const std::vector<PlenumCompliance> plena{{{-1e4, 0.0, 1e4, 3e4}, {3e-5, 4e-5, 6e-5, 9e-5}}};
  PneumaticIntegrator air(supply);
  PneumaticState state = supply.start(0.0, std::vector<double>{4e-5});
  for (int n = 1; n <= 50; ++n) ASSERT_EQ(air.advance(state, 0.01 * n, plena).status, io::RunStatus::completed);
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
