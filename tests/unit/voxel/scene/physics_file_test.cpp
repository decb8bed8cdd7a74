#include "voxel/scene/physics_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "io/text/input_error.h"
#include "io/text/toml_document.h"

namespace menger::voxel {
namespace {

Physics parse(const std::string& text, const Physics& defaults = {}) {
  const io::TomlTable table = io::parse_toml(text, "physics.toml");
  Physics physics = read_physics(table, defaults);
  table.finish();
  return physics;
}

/// The message with which a text is refused, empty if it is accepted.
std::string refusal(const std::string& text) {
  try {
    parse(text);
  } catch (const io::InputError& error) {
    return error.what();
  }
  return {};
}

/// A physics that differs from the defaults in every value, with numbers that have no short decimal form.
Physics unlike_the_defaults() {
  Physics physics;
  physics.materials[0] = {
      .youngs_modulus_Pa = 1e5 / 3.0, .density_kg_m3 = 1e3 / 7.0, .static_friction = 0.1 + 0.2, .kinetic_friction = 0.7};
  physics.materials[1] = {
      .youngs_modulus_Pa = 2e5 / 3.0, .density_kg_m3 = 1e3, .static_friction = 0.0, .kinetic_friction = 1e-300};
  physics.damping_ratios = {.bond = 0.25, .collision = 1.0 / 3.0, .global = 0.0};
  physics.gravity_m_s2 = 9.80665;
  physics.floor = false;
  physics.stop_rotation_in_static_friction = true;
  physics.actuation = {.mode = ActuationMode::wave,
                       .amplitude = 0.1,
                       .period_s = 1.0 / 3.0,
                       .material_phase = {0.125, -0.1},
                       .wave_axis = 2,
                       .wave_periods_per_body = 0.5,
                       .wave_over_gaps = true};
  physics.collisions.exclusion_depth = std::nullopt;
  physics.integration = {.time_step_fraction = 0.09,
                         .damping = DampingMode::velocity,
                         .number = NumberType::float32,
                         .single_precision_rest_lengths = true};
  physics.limits = {.speed_fraction = 0.3, .strain = 2.0};
  return physics;
}

TEST(PhysicsFile, MissingTablesKeepTheDefaults) {
  EXPECT_EQ(parse(""), Physics{});
  EXPECT_EQ(parse("[collisions]\n[materials.material_2]\n", unlike_the_defaults()), unlike_the_defaults());
}

TEST(PhysicsFile, TextReadsBackAsTheSamePhysics) {
  EXPECT_EQ(parse(physics_text(Physics{})), Physics{});
  EXPECT_EQ(parse(physics_text(unlike_the_defaults())), unlike_the_defaults());
}

TEST(PhysicsFile, TextHoldsEveryValueWhateverTheDefaultsAre) {
  EXPECT_EQ(parse(physics_text(Physics{}), unlike_the_defaults()), Physics{});
  EXPECT_EQ(parse(physics_text(unlike_the_defaults()), Physics{}), unlike_the_defaults());
}

TEST(PhysicsFile, TextLeavesOutTermsThatAreNotInUse) {
  EXPECT_EQ(physics_text({}).find("lateral_coupling"), std::string::npos);
  EXPECT_EQ(physics_text({}).find("ramp_s"), std::string::npos);
  Physics physics;
  physics.lateral_coupling = 1.0 / 3.0;
  physics.actuation.mode = ActuationMode::hold;
  physics.actuation.ramp_s = 1.0 / 7.0;
  EXPECT_EQ(parse(physics_text(physics)), physics);
}

TEST(PhysicsFile, TextTellsTheSmallestDifferenceApart) {
  Physics other;
  other.damping_ratios.global = std::nextafter(other.damping_ratios.global, 1.0);
  EXPECT_NE(physics_text(other), physics_text(Physics{}));
}

TEST(PhysicsFile, AMaterialOfItsOwnOverridesTheCommonOne) {
  const Physics physics =
      parse("[materials]\nyoungs_modulus_Pa = 2e4\ndensity_kg_m3 = 20\n[materials.material_2]\nyoungs_modulus_Pa = 5e4\n");
  EXPECT_EQ(physics.materials[0].youngs_modulus_Pa, 2e4);
  EXPECT_EQ(physics.materials[1].youngs_modulus_Pa, 5e4);
  EXPECT_EQ(physics.materials[1].density_kg_m3, 20.0);
}

TEST(PhysicsFile, ExclusionDepthIsAnIntegerOrOff) {
  EXPECT_EQ(parse("collisions.exclusion_depth = 5").collisions.exclusion_depth, 5);
  EXPECT_EQ(parse("collisions.exclusion_depth = \"off\"").collisions.exclusion_depth, std::nullopt);
}

struct BadPhysics {
  std::string text;
  std::string fault;  ///< that the message must name
};

class PhysicsFileRefuses : public testing::TestWithParam<BadPhysics> {};

TEST_P(PhysicsFileRefuses, NamingFileKeyAndValue) {
  const std::string message = refusal(GetParam().text);
  EXPECT_NE(message.find("physics.toml"), std::string::npos) << message;
  EXPECT_NE(message.find(GetParam().fault), std::string::npos) << "no " << GetParam().fault << " in: " << message;
}

INSTANTIATE_TEST_SUITE_P(
    BadValues, PhysicsFileRefuses,
    testing::Values(BadPhysics{"[materials]\nyoungs_modulus_Pa = -1e4", ": materials.youngs_modulus_Pa = -10000.0: must be > 0"},
                    BadPhysics{"[materials]\nyoungs_modulus_Pa = 0", ": materials.youngs_modulus_Pa = 0: must be > 0"},
                    BadPhysics{"[materials.material_2]\ndensity_kg_m3 = -3",
                               ": materials.material_2.density_kg_m3 = -3: must be > 0"},
                    BadPhysics{"[materials]\nkinetic_friction = \"high\"", ": materials.kinetic_friction = \"high\": "},
                    BadPhysics{"[materials]\nyoung = 4", ": materials.young: unknown key"},
                    BadPhysics{"[damping]\nbond = -0.5", ": damping.bond = -0.5: must be >= 0"},
                    BadPhysics{"[environment]\ngravity_m_s2 = -9.75", ": environment.gravity_m_s2 = -9.75: must be >= 0"},
                    BadPhysics{"[environment]\nfloor = 1", ": environment.floor = 1: must be true or false"},
                    BadPhysics{"[actuation]\namplitude = 1.0", ": actuation.amplitude = 1"},
                    BadPhysics{"[actuation]\nperiod_s = 0", ": actuation.period_s = 0: must be > 0"},
                    BadPhysics{"[actuation]\nmode = \"waves\"", ": actuation.mode = \"waves\": "},
                    BadPhysics{"[actuation]\nwave_axis = \"w\"", ": actuation.wave_axis = \"w\": "},
                    BadPhysics{"[actuation]\nmaterial_phase = [0.5]", "must be two numbers, not 1"},
                    BadPhysics{"[collisions]\nexclusion_depth = 0", ": collisions.exclusion_depth = 0: must be >= 1"},
                    BadPhysics{"[collisions]\nexclusion_depth = 1.5", ": collisions.exclusion_depth = 1.5: "},
                    BadPhysics{"[collisions]\nexclusion_depth = \"none\"", ": collisions.exclusion_depth = \"none\": "},
                    BadPhysics{"[integration]\ntime_step_fraction = nan", ": integration.time_step_fraction = nan: "},
                    BadPhysics{"[integration]\nnumber = \"float16\"", ": integration.number = \"float16\": "},
                    BadPhysics{"[integration]\nnumber = \"float32\"",
                               ": integration.number = \"float32\": float32 cannot carry damping from increments"},
                    BadPhysics{"[actuation]\nramp_s = -1", ": actuation.ramp_s = -1: must be >= 0"},
                    BadPhysics{"[materials]\nlateral_coupling = 1", ": materials.lateral_coupling = 1: must be in [0, 1)"},
                    BadPhysics{"[limits]\nstrain = 0", ": limits.strain = 0: must be > 0"},
                    BadPhysics{"limits = 3", ": limits = 3: must be a table"}));

}  // namespace
}  // namespace menger::voxel
