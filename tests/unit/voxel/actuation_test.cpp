#include "voxel/actuation.h"

#include <gtest/gtest.h>

#include "meshes/reference_shapes.h"
#include "voxel/simulation.h"

namespace menger::voxel {
namespace {

TEST(ActuationPhases, FollowTheMaterialInAntiphase) {
  const Lattice lattice(meshes::Polycube::from_digits(2, 1, 1, "12"));
  EXPECT_EQ(actuation_phases(lattice, Actuation{}), (std::vector<double>{0.0, 0.5}));
  Actuation swapped;
  swapped.material_phase = {0.5, 0.0};
  EXPECT_EQ(actuation_phases(lattice, swapped), (std::vector<double>{0.5, 0.0}));
}

TEST(ActuationPhases, GrowAlongTheWaveByOnePeriodPerBody) {
  Actuation wave;
  wave.mode = ActuationMode::wave;
  wave.wave_axis = 0;
  const std::vector<double> phases = actuation_phases(Lattice(meshes::bar(4)), wave);
  EXPECT_EQ(phases, (std::vector<double>{-0.0, -0.25, -0.5, -0.75}));
  wave.wave_over_gaps = true;
  wave.wave_periods_per_body = 0.5;
  EXPECT_DOUBLE_EQ(actuation_phases(Lattice(meshes::bar(4)), wave)[3], 0.5);
}

TEST(ActuationPhases, AreZeroWhenAllMoveTogether) {
  Actuation together;
  together.mode = ActuationMode::in_phase;
  EXPECT_EQ(actuation_phases(Lattice(meshes::Polycube::from_digits(2, 1, 1, "12")), together), (std::vector<double>{0.0, 0.0}));
}

TEST(Drive, SizesFollowTheSineOfTheirPhase) {
  Physics physics;
  physics.floor = false;
  Simulation simulation(meshes::Polycube::from_digits(2, 1, 1, "12"), 0.01, physics);
  ASSERT_EQ(simulation.advance_to(0.03), io::RunStatus::completed);
  const double wave = 0.144714 * std::sin(2.0 * std::numbers::pi * simulation.time_s() / 0.2);
  EXPECT_NEAR(simulation.frame().size_m[0], 0.01 * (1.0 + wave), 1e-16);
  EXPECT_NEAR(simulation.frame().size_m[1], 0.01 * (1.0 - wave), 1e-16);
}

TEST(Drive, SizesHaveTheirDigitsAfterAThousandSeconds) { EXPECT_NEAR(drive_angle(1000.05, 0.2).sine, 1.0, 1e-12); }

}  // namespace
}  // namespace menger::voxel
