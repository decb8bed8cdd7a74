#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

TEST(Divergence, OfTooLargeAStepNamesVoxelQuantityAndTime) {
  Physics physics;
  physics.integration.time_step_fraction = 1.5;
  Simulation simulation(meshes::fractal(meshes::menger_sponge(), 2), 0.01, physics);
  ASSERT_EQ(simulation.advance_to(1.0), io::RunStatus::diverged);
  ASSERT_TRUE(simulation.divergence().has_value());
  const Divergence& divergence = *simulation.divergence();
  EXPECT_TRUE(divergence.quantity == "speed" || divergence.quantity == "strain") << divergence.quantity;
  ASSERT_TRUE(divergence.value.has_value());
  EXPECT_GT(std::abs(*divergence.value), divergence.limit);
  EXPECT_EQ(divergence.time_s, simulation.time_s());
  EXPECT_LT(divergence.voxel, simulation.voxel_count());
  EXPECT_LT(simulation.time_s(), 1.0);
  EXPECT_EQ(simulation.advance(10), io::RunStatus::diverged) << "a diverged run must stay so";
}

TEST(Divergence, IsFoundInWhicheverVoxelItHappens) {
  // One voxel of 400 is thrown; the speed limit is 0.2 sqrt(E / rho) = 6.3 m/s, and the
  // critically damped beams take less than half of the speed in one step.
  const meshes::Polycube body = meshes::fractal(meshes::menger_sponge(), 2);
  for (const std::size_t thrown : {std::size_t{0}, std::size_t{17}, std::size_t{399}}) {
    VoxelLoads loads;
    loads.initial_velocity_m_s.assign(body.count(), {0.0, 0.0, 0.0});
    loads.initial_velocity_m_s[thrown] = {0.0, 0.0, 20.0};
    Simulation simulation(body, 0.01, Physics{}, loads);
    ASSERT_EQ(simulation.advance(5), io::RunStatus::diverged);
    EXPECT_EQ(simulation.divergence()->voxel, thrown);
    EXPECT_EQ(simulation.divergence()->quantity, "speed");
    EXPECT_EQ(simulation.steps(), 1U);
  }
}

TEST(Divergence, NamesWhatIsNotFinite) {
  VoxelLoads loads;
  loads.force_N.assign(3, {0.0, 0.0, 0.0});
  loads.force_N[2][1] = std::numeric_limits<double>::quiet_NaN();
  Simulation simulation(meshes::bar(3), 0.01, Physics{}, loads);
  ASSERT_EQ(simulation.advance(100), io::RunStatus::diverged);
  EXPECT_EQ(simulation.divergence()->quantity, "not finite");
  EXPECT_FALSE(simulation.divergence()->value.has_value());
  EXPECT_EQ(simulation.divergence()->voxel, 2U);
}

TEST(Divergence, ReportsAValueBeyondItsLimitAtEveryLimit) {
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211");
  for (int i = 1; i <= 40; ++i) {
    Physics physics;
    physics.limits.strain = 2e-4 * i;
    Simulation strained(body, 0.01, physics);
    if (strained.advance_to(0.05) == io::RunStatus::diverged) {
      EXPECT_EQ(strained.divergence()->quantity, "strain");
      EXPECT_GT(std::abs(*strained.divergence()->value), physics.limits.strain);
    }
    physics.limits.strain = 1.0;
    physics.limits.speed_fraction = 1e-4 * i;
    Simulation fast(body, 0.01, physics);
    if (fast.advance_to(0.05) == io::RunStatus::diverged) {
      EXPECT_EQ(fast.divergence()->quantity, "speed");
    }
  }
}

TEST(Divergence, LimitsAreOptions) {
  Physics physics;
  physics.limits.strain = 1e-3;
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "211201211201000201211201211");
  Simulation strict(body, 0.01, physics);
  ASSERT_EQ(strict.advance_to(0.2), io::RunStatus::diverged);
  EXPECT_EQ(strict.divergence()->quantity, "strain");
  EXPECT_EQ(strict.divergence()->limit, 1e-3);
  physics.limits.strain = 1.0;
  physics.limits.speed_fraction = 1e-3;  // 0.03 m/s
  Simulation slow(body, 0.01, physics);
  ASSERT_EQ(slow.advance_to(0.2), io::RunStatus::diverged);
  EXPECT_EQ(slow.divergence()->quantity, "speed");
}

TEST(Stop, EndsARunBetweenSteps) {
  std::atomic<bool> stop{true};
  Simulation simulation(meshes::bar(3), 0.01, Physics{});
  EXPECT_EQ(simulation.advance_to(1.0, &stop), io::RunStatus::stopped);
  EXPECT_EQ(simulation.steps(), 0U);
  stop = false;
  EXPECT_EQ(simulation.advance_to(0.01, &stop), io::RunStatus::completed);
}

}  // namespace
}  // namespace menger::voxel
