// Intervals of explicit dynamics: steps that follow a body's stiffness, an energy balance that stays closed, walls that meet.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

/// The hollow cube with its bottom held, of any law.
struct StandingCube {
  meshes::HexahedralMesh mesh = hollow_cube();
  ExplicitBody body;
  explicit StandingCube(const materials::HyperelasticLaw& law) : body(mesh, options_of(mesh, law)) {}

  static ExplicitBodyOptions options_of(const meshes::HexahedralMesh& mesh, const materials::HyperelasticLaw& law) {
    ExplicitBodyOptions options = silicone_options(mesh);
    for (ExplicitRegion& region : options.regions) region.material.law = law;
    options.supports = {{meshes::label_index(mesh, "ground"), {false, false, true}}};
    options.point_supports = {{{0.0, 0.0, 0.0}, {true, true, false}}, {{20e-3, 0.0, 0.0}, {false, true, false}}};
    return options;
  }
};

ExplicitOptions under(const PressureSchedule& schedule, double ramp_s = 0.0) {
  ExplicitOptions options;
  options.schedules = {{schedule, ramp_s}};
  return options;
}

/// Chamber volume over that at rest after one call.
double volume_ratio(const StandingCube& cube, const ExplicitOptions& options, double time_s) {
  ExplicitDynamics dynamics(cube.mesh, cube.body, options);
  const double volume = dynamics.chamber_volumes_m3()[0];
  const ExplicitReport& report = dynamics.advance_to(time_s);
  EXPECT_EQ(report.status, io::RunStatus::completed) << report.reason;
  EXPECT_LT(std::abs(dynamics.energies().imbalance_J()), 0.01 * dynamics.energies().work.pressure_J);
  return dynamics.chamber_volumes_m3()[0] / volume;
}

// A jump that almost triples the chamber while the walls thin: their stable step falls to a fraction within milliseconds. Steps
// near the bound and steps of 2 us differ by their own error, below a hundredth.
TEST(ExplicitAdvance, JumpOfPressureDoesNotDependOnTheStep) {
  const StandingCube cube(materials::NeoHookean{50e3});
  ExplicitOptions options = under(ConstantPressure{9e3});
  const double coarse = volume_ratio(cube, options, 0.015);
  options.largest_step_s = 2e-6;
  const double fine = volume_ratio(cube, options, 0.015);
  EXPECT_GT(fine, 2.0);
  EXPECT_NEAR(coarse, fine, 0.01 * fine);
}

// The same jump after 25 ms in which nothing moved and intervals have become long.
TEST(ExplicitAdvance, LateJumpDoesNotDependOnTheStep) {
  const StandingCube cube(materials::NeoHookean{50e3});
  ExplicitOptions options = under(SquarePressure{.high_Pa = 9e3, .frequency_Hz = 20.0, .phase = 0.5});
  const double coarse = volume_ratio(cube, options, 0.04);
  options.largest_step_s = 2e-6;
  const double fine = volume_ratio(cube, options, 0.04);
  EXPECT_GT(fine, 2.0);
  EXPECT_NEAR(coarse, fine, 0.01 * fine);
}

TEST(ExplicitAdvance, StiffeningLawClosesItsBooks) {
  const StandingCube cube(materials::Yeoh{25e3, 5e3, 3e3});
  EXPECT_GT(volume_ratio(cube, under(ConstantPressure{9e3}), 0.03), 1.1);
}

TEST(ExplicitAdvance, OpenBooksAreNoCompletion) {
  const StandingCube cube(materials::NeoHookean{50e3});
  ExplicitOptions options = under(ConstantPressure{6e3});
  options.largest_imbalance = 1e-9;
  ExplicitDynamics dynamics(cube.mesh, cube.body, options);
  const ExplicitReport report = dynamics.advance_to(0.01);
  EXPECT_EQ(report.status, io::RunStatus::diverged);
  EXPECT_NE(report.reason.find("balance has an error"), std::string::npos) << report.reason;
}

// A vacuum that grows slowly, and one at once: without self-contact walls meet while the chamber still has air, and the energy
// balance is in order.
TEST(ExplicitAdvance, WallsThatMeetEndTheRun) {
  const StandingCube cube(materials::NeoHookean{50e3});
  for (ExplicitOptions options : {under(ConstantPressure{-5e3}, 0.1), under(ConstantPressure{-20e3})}) {
    options.self_contact.reset();
    ExplicitDynamics dynamics(cube.mesh, cube.body, options);
    const double volume = dynamics.chamber_volumes_m3()[0];
    const ExplicitReport report = dynamics.advance_to(0.15);
    EXPECT_EQ(report.status, io::RunStatus::wall_contact) << report.reason;
    EXPECT_NE(report.reason.find("walls of chamber 0 touch at ("), std::string::npos) << report.reason;
    const double ratio = dynamics.chamber_volumes_m3()[0] / volume;
    EXPECT_GT(ratio, 0.2);
    EXPECT_LT(ratio, 0.6);
    const MotionEnergies energies = dynamics.energies();
    EXPECT_LT(std::abs(energies.imbalance_J()), 0.02 * std::abs(energies.work.pressure_J));
  }
}

}  // namespace
}  // namespace menger::fem
