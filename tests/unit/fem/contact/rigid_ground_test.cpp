#include "fem/contact/rigid_ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fem/contact/rigid_ground_file.h"
#include "io/study/study_reader.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"

namespace menger::fem {
namespace {

using Velocity = std::array<double, 2>;
const Friction rough{.static_coefficient = 0.8, .kinetic_coefficient = 0.5};

TEST(Friction, SlidingLosesTheKineticShareAgainstItsDirection) {
  const Velocity after = velocity_after_friction(rough, {0.3, 0.4}, {0.6, 0.8}, 0.2);
  EXPECT_NEAR(after[0], 0.6 * 0.9, 1e-15);
  EXPECT_NEAR(after[1], 0.8 * 0.9, 1e-15);
}

TEST(Friction, NeverTurnsTheVelocityRound) {
  const Velocity after = velocity_after_friction(rough, {1.0, 0.0}, {0.1, 0.0}, 10.0);
  EXPECT_EQ(after[0], 0.0);
  EXPECT_EQ(after[1], 0.0);
}

TEST(Friction, RestHoldsUpToTheStaticCoefficient) {
  EXPECT_EQ(velocity_after_friction(rough, {0.0, 0.0}, {0.79, 0.0}, 1.0)[0], 0.0);
  EXPECT_NEAR(velocity_after_friction(rough, {0.0, 0.0}, {0.81, 0.0}, 1.0)[0], 0.31, 1e-15);
  EXPECT_NEAR(velocity_after_friction(rough, {1e-9, 0.0}, {0.79, 0.0}, 1.0)[0], 0.29, 1e-15);
}

TEST(Friction, NoNormalForceNoFriction) { EXPECT_EQ(velocity_after_friction(rough, {0.0, 0.0}, {1e-6, 0.0}, 0.0)[0], 1e-6); }

// m v' = f - mu_s N v / v_r below the regularisation speed has the steady speed f v_r / (mu_s N).
TEST(Friction, RegularisedPointCreeps) {
  Friction friction = rough;
  friction.regularisation_speed_m_per_s = 0.01;
  Velocity v{0.0, 0.0};
  for (int n = 0; n < 1000; ++n) v = velocity_after_friction(friction, v, {v[0] + 0.4, v[1]}, 1.0);
  EXPECT_NEAR(v[0], 0.01 * 0.4 / 0.8, 1e-12);
  const Velocity fast = velocity_after_friction(friction, {1.0, 0.0}, {2.0, 0.0}, 1.0);
  EXPECT_NEAR(fast[0], 1.5, 1e-15);
}

// A node that slides faster than the regularisation speed feels the kinetic coefficient as long as it stays faster, also where
// the static one could hold it; one that creeps is held.
TEST(Friction, RegularisedPointThatSlidesGoesOnSliding) {
  Friction friction = rough;
  friction.regularisation_speed_m_per_s = 0.01;
  EXPECT_NEAR(velocity_after_friction(friction, {0.6, 0.0}, {0.6, 0.0}, 1.0)[0], 0.1, 1e-15);
  EXPECT_NEAR(velocity_after_friction(friction, {0.005, 0.0}, {0.6, 0.0}, 1.0)[0], 0.6 / 81.0, 1e-15);
  EXPECT_NEAR(velocity_after_friction(friction, {0.6, 0.0}, {0.505, 0.0}, 1.0)[0], 0.505 / 81.0, 1e-15);
}

TEST(Friction, MayDependOnTheDirection) {
  Friction bristles = rough;
  bristles.directional = DirectionalFriction{.forward = {0.0, 1.0}, .backward_factor = 3.0, .sideways_factor = 2.0};
  EXPECT_DOUBLE_EQ(directional_factor(bristles, {0.0, 5.0}), 1.0);
  EXPECT_DOUBLE_EQ(directional_factor(bristles, {0.0, -5.0}), 3.0);
  EXPECT_DOUBLE_EQ(directional_factor(bristles, {5.0, 0.0}), 2.0);
  EXPECT_NEAR(directional_factor(bristles, {1.0, 1.0}), 1.5, 1e-15);
  EXPECT_DOUBLE_EQ(directional_factor(bristles, {0.0, 0.0}), 1.0);
  EXPECT_NEAR(velocity_after_friction(bristles, {0.0, -1.0}, {0.0, -2.0}, 1.0)[1], -0.5, 1e-15);
  EXPECT_EQ(velocity_after_friction(bristles, {0.0, 0.0}, {0.0, -2.0}, 1.0)[1], 0.0);
}

StudyGround parse(const std::string& text) {
  StudyGround ground;
  io::read_described(io::parse_toml(text, "ground.toml"), ground);
  return ground;
}

RigidGround read(const std::string& text) { return parse(text).ground(0.25, 7e7); }

TEST(RigidGroundFile, StatesWhatItMayAndTakesTheRestFromItsDefaults) {
  const RigidGround plain = read("static_friction = 0.6\nkinetic_friction = 0.5\n");
  EXPECT_EQ(plain.friction.static_coefficient, 0.6);
  EXPECT_EQ(plain.friction.kinetic_coefficient, 0.5);
  EXPECT_EQ(plain.height_m, 0.25);
  EXPECT_EQ(plain.stiffness_Pa_per_m, 7e7);
  EXPECT_FALSE(plain.friction.directional);
  const RigidGround bristles = read(
      "static_friction = 0.6\nkinetic_friction = 0.5\nheight_m = -1e-3\nstiffness_Pa_per_m = 1e6\n"
      "regularisation_speed_m_per_s = 1e-3\n[directional]\nforward = [0, 2]\nbackward_factor = 3\n");
  EXPECT_EQ(bristles.height_m, -1e-3);
  EXPECT_EQ(bristles.stiffness_Pa_per_m, 1e6);
  EXPECT_EQ(bristles.friction.regularisation_speed_m_per_s, 1e-3);
  EXPECT_EQ(bristles.friction.directional->forward[1], 1.0);
  EXPECT_EQ(bristles.friction.directional->backward_factor, 3.0);
  EXPECT_EQ(bristles.friction.directional->sideways_factor, 1.0);
}

TEST(RigidGroundFile, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(read("static_friction = 0.4\nkinetic_friction = 0.5\n"), io::InputError);
  EXPECT_THROW(read("static_friction = 0.4\nkinetic_friction = -0.5\n"), io::InputError);
  EXPECT_THROW(read("static_friction = 0.4\n"), io::InputError);
  const std::string rough_ground = "static_friction = 0.6\nkinetic_friction = 0.5\n";
  EXPECT_THROW(read(rough_ground + "stiffness_Pa_per_m = 0\n"), io::InputError);
  EXPECT_THROW(read(rough_ground + "[directional]\nforward = [0, 0]\n"), io::InputError);
  EXPECT_THROW(read(rough_ground + "[directional]\nforward = [1, 0, 0]\n"), io::InputError);
  const std::string old_names = tests::message_of([] { (void)read("kinetic_coefficient = 0.5\nstatic_friction = 0.6\n"); });
  EXPECT_NE(old_names.find("kinetic_coefficient = 0.5: is called kinetic_friction now"), std::string::npos) << old_names;
}

TEST(RigidGroundFile, TemplateAndTextsAreRead) {
  tests::expect_template_is_read<StudyGround>(parse);
  tests::expect_texts_are_read_back<StudyGround>(parse);
}

}  // namespace
}  // namespace menger::fem
