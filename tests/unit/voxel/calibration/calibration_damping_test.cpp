#include "voxel/calibration/calibration_damping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace menger::voxel {
namespace {

SurrogateParameters tube() {
  SurrogateParameters p;
  p.cell_edge_m = 0.01;
  p.wall_thickness_m = 0.002;
  p.density_kg_m3 = 1000.0;
  p.axial_Pa.fill(160e3);
  return p;
}

TEST(CalibrationDamping, ChainOfTwoCellsLosesWhatTheTestSays) {
  // Two cells joined by a spring k = EA / L and a damper c = zeta sqrt(k m), as beams have it. Forced at frequency f the joint
  // loses pi c omega u^2 per cycle and stores k u^2 / 2: tan(delta) = c omega / k.
  const materials::LossData loss{.source = "test", .tan_delta = 0.1, .frequency_Hz = 3.0};
  const SurrogateParameters p = tube();
  const double stiffness = 160e3 * 0.01;
  const double mass = 1000.0 * (1e-6 - 0.006 * 0.006 * 0.01);  // the walls of a tube of one cell
  const double damper = bond_damping_ratio(p, loss) * std::sqrt(stiffness * mass);
  EXPECT_NEAR(damper * 2.0 * std::numbers::pi * 3.0 / stiffness, 0.1, 1e-12);
}

TEST(CalibrationDamping, FallsWithTheFrequencyOfTheTest) {
  const double slow = bond_damping_ratio(tube(), {.source = "test", .tan_delta = 0.1, .frequency_Hz = 1.0});
  const double fast = bond_damping_ratio(tube(), {.source = "test", .tan_delta = 0.1, .frequency_Hz = 4.0});
  EXPECT_NEAR(slow / fast, 4.0, 1e-12);
}

}  // namespace
}  // namespace menger::voxel
