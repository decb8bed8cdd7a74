#include "voxel/model/actuation.h"

#include <gtest/gtest.h>

#include "meshes/design/reference_shapes.h"
#include "voxel/lanes/simulation.h"

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

TEST(Drive, RatesAreTheDerivativesOfAShapedDrive) {
  for (const ActuationMode mode : {ActuationMode::in_phase, ActuationMode::hold}) {
    const Actuation actuation{.mode = mode, .frequency_Hz = 1.0 / 0.7, .ramp_s = 0.5};
    for (const double time : {0.1, 0.3, 0.8}) {
      // Central differences of a smooth function of order one: both errors are below 1e-8.
      const double h = 1e-5;
      const DriveMoment below = drive_moment(actuation, time - h);
      const DriveMoment above = drive_moment(actuation, time + h);
      const DriveMoment now = drive_moment(actuation, time);
      EXPECT_NEAR(now.sine_rate, (above.sine - below.sine) / (2.0 * h), 1e-7);
      EXPECT_NEAR(now.cosine_rate, (above.cosine - below.cosine) / (2.0 * h), 1e-7);
      EXPECT_NEAR(now.ramp_rate, (above.ramp - below.ramp) / (2.0 * h), 1e-7);
    }
  }
}

TEST(Drive, RampsFromZeroToItsSineOrItsTop) {
  const Actuation wave{.mode = ActuationMode::in_phase, .frequency_Hz = 2.5, .ramp_s = 0.2};
  EXPECT_EQ(drive_moment(wave, 0.0).sine, 0.0);
  EXPECT_EQ(drive_moment(wave, 0.0).cosine, 0.0);
  EXPECT_DOUBLE_EQ(drive_moment(wave, 0.1).sine, 0.5);
  EXPECT_DOUBLE_EQ(drive_moment(wave, 0.5).sine, 1.0);
  const Actuation hold{.mode = ActuationMode::hold, .ramp_s = 0.2};
  EXPECT_DOUBLE_EQ(drive_moment(hold, 0.05).sine, 0.25);
  EXPECT_EQ(drive_moment(hold, 17.0).sine, 1.0);
  EXPECT_EQ(drive_moment(hold, 17.0).cosine, 0.0);
}

}  // namespace
}  // namespace menger::voxel
