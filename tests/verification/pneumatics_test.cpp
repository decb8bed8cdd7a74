// Pneumatic supplies of rigid plena against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "fem/pneumatics/pneumatic_integrator.h"

namespace menger::fem {
namespace {

constexpr double tau = 2.0 * std::numbers::pi;
constexpr double plenum_m3 = 4e-5;
const std::vector<double> rigid{plenum_m3};

/// Pressure in a rigid plenum at a time, after equal steps.
double pressure_after(const PneumaticSupply& supply, double end_s, int steps) {
  PneumaticIntegrator air(supply);
  PneumaticState state = supply.start(0.0, rigid);
  for (int n = 1; n <= steps; ++n) EXPECT_EQ(air.advance(state, end_s * n / steps, rigid).status, io::RunStatus::completed);
  return supply.pressure_Pa(state, 0);
}

// Isothermal: dP/dt = (S^2 - P^2) / (2 R V), so P = S tanh(S t / (2 R V) + artanh(P0 / S)); with S < P0 the same with coth. The
// line's volume counts half. Whatever the steps of the caller, the error stays below a thousand tolerances of 1e-9.
TEST(Pneumatics, RigidPlenumFillsByTheHyperbolicTangent) {
  const double resistance = 1e8;
  const double line_m3 = 8e-6;
  const double volume = plenum_m3 + 0.5 * line_m3;
  for (const double source : {2e5, 2e4, -5e4}) {
    const PneumaticSupply supply({LineSupply{{ConstantPressure{source}}, {resistance, line_m3}}});
    const double end_s = resistance * volume / standard_atmosphere_Pa;
    const double absolute = source + standard_atmosphere_Pa;
    const double growth = std::exp(-absolute * end_s / (resistance * volume));
    // tanh(x + artanh(q)) for any q > 0, by exponentials
    const double gap = (absolute - standard_atmosphere_Pa) / (absolute + standard_atmosphere_Pa) * growth;
    const double exact = absolute * (1.0 - gap) / (1.0 + gap) - standard_atmosphere_Pa;
    for (const int steps : {1, 7, 100}) {
      EXPECT_NEAR(pressure_after(supply, end_s, steps), exact, 1e-6 * absolute) << source << " in " << steps;
    }
  }
}

// Small differences: an exponential with the time R V / (n P_ambient).
TEST(Pneumatics, SmallDifferencesDecayExponentially) {
  for (const double exponent : {1.0, 1.4}) {
    const PneumaticSupply supply({LineSupply{{ConstantPressure{1.0}}, {1e8, 0.0}}}, {}, {.exponent = exponent});
    const double time_s = 1e8 * plenum_m3 / (exponent * standard_atmosphere_Pa);
    EXPECT_NEAR(pressure_after(supply, time_s, 1000), 1.0 - std::exp(-1.0), 1e-5);
  }
}

// A piston against a rigid plenum, without resistance: P V^n is the same at any time.
TEST(Pneumatics, PistonCompressesByTheGasLaw) {
  const Piston piston{.name = "cam",
                      .bore_m = 0.03,
                      .cylinder_length_m = 0.05,
                      .stroke_m = 0.04,
                      .dead_volume_m3 = 1e-6,
                      .frequency_Hz = 1.0,
                      .phase = 0.2,
                      .fill_pressure_Pa = -2e3};
  const double line_m3 = 3e-6;
  for (const double exponent : {1.0, 1.4}) {
    const PneumaticSupply supply({PistonSupply{0, {0.0, line_m3}}}, {piston}, {.exponent = exponent});
    const auto volume = [&](double time_s) { return cylinder_volume_m3(piston, time_s) + line_m3 + plenum_m3; };
    PneumaticIntegrator air(supply);
    PneumaticState state = supply.start(0.0, rigid);
    for (int n = 1; n <= 30; ++n) {
      const double time_s = 0.025 * n;
      ASSERT_EQ(air.advance(state, time_s, rigid).status, io::RunStatus::completed);
      const double ratio = std::pow(volume(0.0) / volume(time_s), exponent);
      const double exact = (standard_atmosphere_Pa - 2e3) * ratio - standard_atmosphere_Pa;
      EXPECT_NEAR(supply.pressure_Pa(state, 0), exact, 1e-8);
      EXPECT_NEAR(supply.piston_pressure_Pa(state, 0), exact, 1e-8);
    }
  }
}

/// Time in which a rigid plenum of isothermal air goes from one absolute pressure to another behind a source: int V / (P_ambient
/// dN/dt) dP, by Simpson's rule.
double filling_time_s(const PneumaticLine& line, double volume_m3, double source_Pa, double from_Pa, double to_Pa) {
  constexpr int intervals = 2000;
  double sum = 0.0;
  for (int n = 0; n <= intervals; ++n) {
    const double absolute = std::lerp(from_Pa, to_Pa, static_cast<double>(n) / intervals);
    const double flow = line_flow_m3_per_s({}, line, source_Pa, absolute - standard_atmosphere_Pa);
    sum += (n == 0 || n == intervals ? 1.0 : (n % 2 == 1 ? 4.0 : 2.0)) / flow;
  }
  return volume_m3 / standard_atmosphere_Pa * (to_Pa - from_Pa) / intervals / 3.0 * sum;
}

// The flow turns laminar on the way. The time of that is found by quadrature, and that of any pressure beyond it.
TEST(Pneumatics, TurnOfTheFlowIsFoundWithinTheTolerance) {
  const PneumaticLine line = round_line_of(2.0, 1e7);
  const double source = 2e4;
  const double absolute = source + standard_atmosphere_Pa;
  const double volume = plenum_m3 + 0.5 * line.volume_m3;
  const double turn = std::sqrt(absolute * absolute - 2.0 * standard_atmosphere_Pa * laminar_drive_Pa({}, line));
  ASSERT_GT(turn, standard_atmosphere_Pa + 1e3);
  const double turn_s = filling_time_s(line, volume, source, standard_atmosphere_Pa, turn);
  const double beyond = 0.5 * (turn + absolute);
  const double beyond_s = turn_s + filling_time_s(line, volume, source, turn, beyond);
  const PneumaticSupply supply({LineSupply{{ConstantPressure{source}}, line}});
  for (const int steps : {1, 3}) {
    EXPECT_NEAR(pressure_after(supply, turn_s, steps), turn - standard_atmosphere_Pa, 1e-6 * absolute) << steps;
    EXPECT_NEAR(pressure_after(supply, beyond_s, steps), beyond - standard_atmosphere_Pa, 1e-6 * absolute) << steps;
  }
}

// One advance, steps of the integrator's own choice: the error goes with the tolerance.
TEST(Pneumatics, ErrorFollowsTheTolerance) {
  const double source = 5e4;
  const double absolute = source + standard_atmosphere_Pa;
  const double resistance = 1e8;
  const PneumaticSupply supply({LineSupply{{ConstantPressure{source}}, {resistance, 0.0}}});
  const double end_s = 0.5 * 2.0 * resistance * plenum_m3 / absolute;
  const double exact = absolute * std::tanh(0.5 + std::atanh(standard_atmosphere_Pa / absolute)) - standard_atmosphere_Pa;
  double last = std::numeric_limits<double>::infinity();
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    PneumaticIntegrator air(supply, {.tolerance = tolerance});
    PneumaticState state = supply.start(0.0, rigid);
    ASSERT_EQ(air.advance(state, end_s, rigid).status, io::RunStatus::completed);
    const double error = std::abs(supply.pressure_Pa(state, 0) - exact) / absolute;
    EXPECT_LT(error, 100.0 * tolerance);
    EXPECT_LT(error, 0.1 * last) << tolerance;
    last = error;
  }
}

/// First Fourier coefficient of the plenum's pressure, per cosine of the drive, in the tenth period and relative to it.
std::complex<double> response(const PneumaticSupply& supply, double frequency_Hz) {
  constexpr int steps = 2000;
  PneumaticIntegrator air(supply);
  PneumaticState state = supply.start(0.0, rigid);
  std::complex<double> sum = 0.0;
  for (int n = 1; n <= 10 * steps; ++n) {
    EXPECT_EQ(air.advance(state, n / (steps * frequency_Hz), rigid).status, io::RunStatus::completed);
    if (n > 9 * steps) sum += 2.0 / steps * supply.pressure_Pa(state, 0) * std::polar(1.0, -tau * n / steps);
  }
  return sum;
}

// A source of 1 Pa behind resistance and volume is a low-pass filter of first order: 1 / (1 + i w t), t = R V / (n P_ambient).
TEST(Pneumatics, LineAndPlenumAreALowPass) {
  for (const double exponent : {1.0, 1.4}) {
    const double resistance = 1e9;
    const double time_s = resistance * plenum_m3 / (exponent * standard_atmosphere_Pa);
    for (const double by_corner : {0.1, 1.0, 5.0}) {
      const double frequency_Hz = by_corner / (tau * time_s);
      const PneumaticSupply supply(
          {LineSupply{{SinePressure{.low_Pa = 1.0, .high_Pa = -1.0, .frequency_Hz = frequency_Hz}}, {resistance, 0.0}}}, {},
          {.exponent = exponent});
      const std::complex<double> exact = 1.0 / std::complex<double>(1.0, by_corner);
      // 1 Pa of 1e5 Pa bends the law by 1e-5; what is left of the start after ten periods is exp(-4 pi) at the highest frequency
      EXPECT_LT(std::abs(response(supply, frequency_Hz) - exact), 3e-5 * std::abs(exact)) << by_corner;
    }
  }
}

// A piston that displaces little, d cos(w t): p = n P_ambient d / (V + C (1 + i w t)), C the cylinder with half of the line, V
// the plenum with the other half.
TEST(Pneumatics, PistonBehindALineIsALowPass) {
  const PneumaticLine line{1e9, 6e-6};
  const double volume = plenum_m3 + 3e-6;
  const double time_s = line.resistance_Pa_s_per_m3 * volume / (1.4 * standard_atmosphere_Pa);
  for (const double by_corner : {0.3, 3.0}) {
    const double frequency_Hz = by_corner / (tau * time_s);
    const Piston piston{
        .name = "cam", .bore_m = 0.03, .cylinder_length_m = 0.05, .stroke_m = 1e-6, .frequency_Hz = frequency_Hz, .phase = 0.5};
    const PneumaticSupply supply({PistonSupply{0, line}}, {piston}, {.exponent = 1.4});
    const double cylinder = cylinder_volume_m3(piston, 0.25 / frequency_Hz) + 3e-6;
    const std::complex<double> exact =
        1.4 * standard_atmosphere_Pa * 0.5 * swept_volume_m3(piston) / (volume + cylinder * std::complex<double>(1.0, by_corner));
    EXPECT_LT(std::abs(response(supply, frequency_Hz) - exact), 1e-4 * std::abs(exact)) << by_corner;
  }
}

}  // namespace
}  // namespace menger::fem
