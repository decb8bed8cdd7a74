// Explicit dynamics of the hollow cube under chamber pressure, against numbers that implicit elements and other codes found, and
// against itself.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

/// The cube of the cross-code table: bottom held in z, two points against the rigid motions that are left.
ExplicitBodyOptions standing(const meshes::HexahedralMesh& mesh, double viscosity_Pa_s = 0.0) {
  ExplicitBodyOptions options = silicone_options(mesh, viscosity_Pa_s);
  options.supports = {{meshes::label_index(mesh, "ground"), {false, false, true}}};
  options.point_supports = {{{0.0, 0.0, 0.0}, {true, true, false}}, {{20e-3, 0.0, 0.0}, {false, true, false}}};
  return options;
}

double top_m(const meshes::HexahedralMesh& mesh, const ExplicitDynamics& dynamics) {
  return dynamics.state().displacements_m[3 * node_at(mesh, {0.01, 0.01, 0.02}) + 2];
}

// The static numbers of Q1/P0 with one element through the wall at 6 kPa that other finite-element codes and the implicit solver
// here find: top 3.2637 mm, chamber volume + 59.833 %, strain energy 7.0827 mJ. Damped long enough that what moves is smaller
// than their last digit.
TEST(ExplicitChamber, SlowPressureReachesTheStaticState) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, standing(mesh));
  ExplicitOptions options;
  options.loads.mass_damping_per_s = 100.0;
  options.schedules = {{ConstantPressure{6e3}, 0.1}};
  ExplicitDynamics dynamics(mesh, body, options);
  const double volume = dynamics.chamber_volumes_m3()[0];
  ASSERT_EQ(dynamics.advance_to(0.35).status, io::RunStatus::completed);
  EXPECT_NEAR(top_m(mesh, dynamics), 3.2637e-3, 1e-7);
  EXPECT_NEAR(dynamics.chamber_volumes_m3()[0] / volume - 1.0, 0.59833, 1e-5);
  EXPECT_NEAR(dynamics.energies().strain_J, 7.0827e-3, 1e-7);
}

// A jump of 1 Pa excites the breathing mode. `menger modes` finds it, the seventh, at 105.299 Hz on the same mesh (study
// fem/studies/reference_cube.toml with degree 1, 1070 kg/m^3, 0 kPa) with a consistent mass matrix; lumped masses are 0.2 % lower
// there. The frequency comes from 20 periods of the top's speed.
TEST(ExplicitChamber, BreathesAtTheFrequencyOfTheMode) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, standing(mesh));
  ExplicitOptions options;
  options.schedules = {{ConstantPressure{1.0}, 0.0}};
  ExplicitDynamics dynamics(mesh, body, options);
  const std::size_t top = 3 * node_at(mesh, {0.01, 0.01, 0.02}) + 2;
  std::vector<double> crossings;
  double last = 0.0;
  constexpr double interval = 2e-4;
  for (int n = 1; crossings.size() < 41 && n < 2000; ++n) {
    ASSERT_EQ(dynamics.advance_to(interval * n).status, io::RunStatus::completed);
    const double speed = dynamics.velocities_m_per_s()[top];
    if (n > 1 && last * speed < 0.0) crossings.push_back(interval * (n - speed / (speed - last)));
    last = speed;
  }
  ASSERT_EQ(crossings.size(), 41U);
  EXPECT_NEAR(20.0 / (crossings.back() - crossings.front()), 105.299, 0.005 * 105.299);
}

ExplicitOptions cycling(double frequency_Hz) {
  ExplicitOptions options;
  options.schedules = {{SinePressure{.low_Pa = 0.0, .high_Pa = 4e3, .frequency_Hz = frequency_Hz}, 0.0}};
  return options;
}

// One cycle without friction: the energy balance closes to a thousandth of the largest work, with and without viscosity. Natural
// frequencies begin at 70 Hz: at 20 Hz the body does not follow its static states, and kinetic energy takes part.
TEST(ExplicitChamber, EnergyIsBalancedOverACycle) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  for (const double viscosity : {0.0, 5.0}) {
    const ExplicitBody body(mesh, standing(mesh, viscosity));
    ExplicitDynamics dynamics(mesh, body, cycling(20.0));
    double largest = 0.0;
    double worst = 0.0;
    for (int n = 1; n <= 20; ++n) {
      ASSERT_EQ(dynamics.advance_to(0.0025 * n).status, io::RunStatus::completed);
      const MotionEnergies energies = dynamics.energies();
      largest = std::max(largest, energies.work.pressure_J);
      worst = std::max(worst, std::abs(energies.imbalance_J()));
    }
    EXPECT_GT(largest, 1e-3);
    EXPECT_LT(worst, 1e-3 * largest) << viscosity;
    EXPECT_GE(dynamics.energies().work.viscous_J, viscosity > 0.0 ? 0.01 * largest : 0.0);
  }
}

// The same cycle with three steps: differences shrink at least as the square of the step, and are below 1e-3 at the first.
TEST(ExplicitChamber, StepHasNoInfluence) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, standing(mesh, 2.0));
  std::vector<double> tops;
  for (const double step : {24e-6, 12e-6, 6e-6}) {
    ExplicitOptions options = cycling(20.0);
    options.largest_step_s = step;
    ExplicitDynamics dynamics(mesh, body, options);
    ASSERT_EQ(dynamics.advance_to(0.03).status, io::RunStatus::completed);
    tops.push_back(top_m(mesh, dynamics));
  }
  EXPECT_NEAR(tops[0], tops[2], 1e-3 * tops[2]);
  EXPECT_LT(std::abs(tops[1] - tops[2]), 0.6 * std::abs(tops[0] - tops[1]));  // viscosity makes it first order: 1/2 is the limit
}

// A jump of pressure at the start: the wall swings, and the pressure's work is p dV at any time.
TEST(ExplicitChamber, PressureWorkIsPressureTimesVolume) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, standing(mesh, 5.0));
  ExplicitOptions options;
  options.schedules = {{ConstantPressure{3e3}, 0.0}};  // a jump at the start
  ExplicitDynamics dynamics(mesh, body, options);
  const double volume = dynamics.chamber_volumes_m3()[0];
  ASSERT_EQ(dynamics.advance_to(0.02).status, io::RunStatus::completed);
  const double work = 3e3 * (dynamics.chamber_volumes_m3()[0] - volume);
  EXPECT_NEAR(dynamics.energies().work.pressure_J, work, 1e-3 * work);
}

}  // namespace
}  // namespace menger::fem
