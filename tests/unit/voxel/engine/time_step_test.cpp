#include "voxel/engine/time_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshes/design/reference_shapes.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

TEST(RecommendedTimeStep, IsThatOfThePaper) {
  // The public engine gives 5.0329214e-5 s in single precision.
  EXPECT_NEAR(recommended_time_step_s(meshes::bar(3), 0.01, Physics{}), 5.0329214e-5, 1e-11);
  Physics physics;
  EXPECT_DOUBLE_EQ(Simulation(meshes::bar(3), 0.01, physics).time_step_s(),
                   0.9 * recommended_time_step_s(meshes::bar(3), 0.01, physics));
}

TEST(RecommendedTimeStep, TakesTheHarmonicStiffnessOverTheLighterEnd) {
  Physics physics;
  physics.materials[1].youngs_modulus_Pa = 3e4;
  physics.materials[1].density_kg_m3 = 1000.0;
  const double k_over_m = 1.5e4 * 0.01 / (10.0 * 1e-6);
  EXPECT_NEAR(recommended_time_step_s(meshes::Polycube::from_digits(2, 1, 1, "12"), 0.01, physics) *
                  (2.0 * std::numbers::pi * std::sqrt(k_over_m)),
              1.0, 1e-14);
}

TEST(RecommendedTimeStep, OfASingleVoxelIsItsOwn) {
  EXPECT_NEAR(recommended_time_step_s(meshes::bar(1), 0.01, Physics{}), 1.0 / (2.0 * std::numbers::pi * std::sqrt(1e7)), 1e-18);
}

}  // namespace
}  // namespace menger::voxel
