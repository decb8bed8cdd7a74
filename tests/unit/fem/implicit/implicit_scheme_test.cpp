#include "fem/implicit/implicit_scheme.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace menger::fem {
namespace {

// Chung and Hulbert's choice: the trapezoidal rule for 1, and of second order and largest damping for all.
TEST(GeneralisedAlpha, CoefficientsAreThoseOfItsSpectralRadius) {
  const GeneralisedAlpha trapezoidal = generalised_alpha(1.0);
  EXPECT_DOUBLE_EQ(trapezoidal.alpha_m, 0.5);
  EXPECT_DOUBLE_EQ(trapezoidal.alpha_f, 0.5);
  EXPECT_DOUBLE_EQ(trapezoidal.beta, 0.25);
  EXPECT_DOUBLE_EQ(trapezoidal.gamma, 0.5);
  EXPECT_NEAR(trapezoidal.error_constant, 1.0 / 12.0, 1e-15);
  EXPECT_NEAR(generalised_alpha(0.0).error_constant, 1.0 / 3.0, 1e-15);
}

struct Oscillator {
  double u;
  double v;
  double a;
};

/// A step of u'' = -omega^2 u.
Oscillator step(const GeneralisedAlpha& s, const Oscillator& at, double h, double omega) {
  const double square = omega * omega;
  const double predicted = at.u + h * at.v + h * h * (0.5 - s.beta) * at.a;
  const double rest = s.alpha_m * at.a + square * (s.alpha_f * at.u + (1.0 - s.alpha_f) * predicted);
  const double a = -rest / (1.0 - s.alpha_m + (1.0 - s.alpha_f) * s.beta * h * h * square);
  return {predicted + s.beta * h * h * a, at.v + h * ((1.0 - s.gamma) * at.a + s.gamma * a), a};
}

// Motion much faster than a step shrinks by rho in each. The root is threefold: n^2 rho^n, which adds 2 / n.
TEST(GeneralisedAlpha, FastMotionIsDampedByTheSpectralRadius) {
  for (const double rho : {0.5, 0.8}) {
    const GeneralisedAlpha scheme = generalised_alpha(rho);
    const auto amplitude = [&](int steps) {
      Oscillator at{1.0, 0.0, -1e8};
      for (int n = 0; n < steps; ++n) at = step(scheme, at, 1.0, 1e4);
      return std::abs(at.u);
    };
    EXPECT_NEAR(std::pow(amplitude(420) / amplitude(400), 1.0 / 20.0), rho, 0.01 * rho);
  }
}

// Of a step from the exact motion, with the acceleration where the scheme has it, (alpha_m - alpha_f) steps later: the estimate
// is right to the order of the step, 1/20 of a radian here.
TEST(GeneralisedAlpha, EstimatesTheErrorOfAStep) {
  constexpr double h = 0.05;
  for (const double rho : {0.0, 0.5, 0.8, 1.0}) {
    const GeneralisedAlpha scheme = generalised_alpha(rho);
    const double phase = 0.7;
    const double shift = (scheme.alpha_m - scheme.alpha_f) * h;
    const Oscillator start{std::cos(phase), -std::sin(phase), -std::cos(phase + shift)};
    const Oscillator end = step(scheme, start, h, 1.0);
    const double estimate = scheme.error_constant * h * h * (end.a - start.a);
    EXPECT_NEAR(end.u - std::cos(phase + h), estimate, 0.15 * std::abs(estimate)) << rho;
  }
}

TEST(GeneralisedAlpha, StepsFollowTheErrorOfThirdOrder) {
  EXPECT_DOUBLE_EQ(next_step_s(1.0, 8.0, 1.0), 0.4);
  EXPECT_DOUBLE_EQ(next_step_s(1.0, 1e9, 1.0), 0.2);
  EXPECT_DOUBLE_EQ(next_step_s(1.0, 0.4, 1.0), 1.0);  // not worth a factorisation
  EXPECT_DOUBLE_EQ(next_step_s(1.0, 0.125, 1.0), 1.5);
  EXPECT_DOUBLE_EQ(next_step_s(1.0, 0.0, 1.0), 1.5);
  // shortened to end with others: from the longer one, as far as the error of the shorter one goes
  EXPECT_DOUBLE_EQ(next_step_s(1.0, 0.0, 1.8), 2.7);
  EXPECT_DOUBLE_EQ(next_step_s(1.0, 0.064, 1.8), 2.0);
}

TEST(GeneralisedAlpha, StepsShowEverySchedule) {
  EXPECT_FALSE(longest_step_s(std::vector<PlenumSchedule>{{ConstantPressure{1e3}, 0.0}}));
  const std::vector<PlenumSchedule> schedules{{SinePressure{.high_Pa = 1.0, .frequency_Hz = 2.0}, 0.0},
                                              {SquarePressure{.high_Pa = 1.0, .frequency_Hz = 1.0, .rise_s = 0.02}, 0.1},
                                              {PressureTable{{0.0, 0.5, 0.512}, {0.0, 1.0, 2.0}}, 0.0}};
  EXPECT_NEAR(longest_step_s(std::span(schedules).first(1)).value(), 0.025, 1e-15);
  EXPECT_NEAR(longest_step_s(std::span(schedules).first(2)).value(), 0.01, 1e-15);
  EXPECT_NEAR(longest_step_s(schedules).value(), 0.006, 1e-15);
}

}  // namespace
}  // namespace menger::fem
