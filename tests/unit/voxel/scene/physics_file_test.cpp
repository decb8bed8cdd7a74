#include "voxel/scene/physics_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "io/study/study_reader.h"
#include "io/text/input_error.h"
#include "io/text/toml_document.h"
#include "tests/support/described_study.h"
#include "tests/support/surrogate_example.h"
#include "voxel/model/surrogate_file.h"

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
  physics.lateral_coupling = 1.0 / 3.0;
  physics.beam_moments = BeamMoments::balanced;
  physics.damping_ratios = {.bond = 0.25, .collision = 1.0 / 3.0, .global = 0.0};
  physics.gravity_m_s2 = 9.80665;
  physics.floor = false;
  physics.stop_rotation_in_static_friction = true;
  physics.actuation = {.mode = ActuationMode::wave,
                       .amplitude = 0.1,
                       .frequency_Hz = 10.0 / 3.0,
                       .ramp_s = 1.0 / 7.0,
                       .material_phase = {0.125, -0.1},
                       .wave_axis = 2,
                       .wave_periods_per_body = 0.5,
                       .wave_over_gaps = true};
  physics.collisions.exclusion_depth = std::nullopt;
  physics.integration = {.time_step_fraction = 0.09,
                         .damping = DampingMode::velocity,
                         .number = NumberType::float32,
                         .bond_damping = BondDamping::semi_implicit,
                         .single_precision_rest_lengths = true};
  physics.limits = {.speed_fraction = 0.3, .strain = 2.0};
  return physics;
}

/// Hollow cells instead of solid voxels.
Physics calibrated() {
  Physics physics;
  physics.materials[0].static_friction = 0.25;
  physics.actuation.mode = ActuationMode::in_phase;
  physics.actuation.frequency_Hz = 4.0;
  physics.actuation.ramp_s = 0.5;
  physics.surrogate = {.parameters = tests::surrogate_example(),
                       .pressure_Pa = {-1e3, 1.5e3},
                       .chambers = meshes::ChamberLayout::per_phase,
                       .outside_range = OutsideRange::warn};
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
  Physics other = unlike_the_defaults();
  other.beam_moments = BeamMoments::published;  // which a text leaves out, as those of earlier versions do
  EXPECT_EQ(parse(physics_text(Physics{}), other), Physics{});
  EXPECT_EQ(parse(physics_text(unlike_the_defaults()), Physics{}), unlike_the_defaults());
}

TEST(PhysicsFile, TextOfPublishedMomentsIsThatOfEarlierVersions) {
  EXPECT_EQ(physics_text(Physics{}).find("beam_moments"), std::string::npos);
  EXPECT_NE(physics_text(unlike_the_defaults()).find("beam_moments = \"balanced\""), std::string::npos);
}

TEST(PhysicsFile, TextOfACalibratedBodyReadsBackWithItsParameters) {
  EXPECT_EQ(parse(physics_text(calibrated())), calibrated());
  EXPECT_EQ(parse(physics_text(calibrated()), unlike_the_defaults()), calibrated());
  EXPECT_EQ(parse("[integration]\ndamping = \"increments\"\n", calibrated()), calibrated()) << "what is missing is kept";
}

TEST(PhysicsFile, TemplateIsReadToTheDefaultsAndToEachAlternative) {
  const std::set<std::string> refused{"surrogate", "integration.number = \"float32\""};
  tests::expect_template_is_read<Physics>([](const std::string& text) { return parse(text); }, refused);
}

TEST(PhysicsFile, TextsOfAllPhysicsAreReadBack) {
  tests::expect_texts_are_read_back<Physics>([](const std::string& text) { return parse(text); });
}

/// What version 1 of the archives holds.
constexpr const char* earlier_text = R"([materials]
lateral_coupling = 0.3333333333333333
[materials.material_1]
youngs_modulus_Pa = 33333.333333333336
density_kg_m3 = 142.85714285714286
static_friction = 0.30000000000000004
kinetic_friction = 0.7
[materials.material_2]
youngs_modulus_Pa = 66666.66666666667
density_kg_m3 = 1000
static_friction = 0
kinetic_friction = 1e-300
[damping]
bond = 0.25
collision = 0.3333333333333333
global = 0
[environment]
gravity_m_s2 = 9.80665
floor = false
stop_rotation_in_static_friction = true
[actuation]
mode = "wave"
amplitude = 0.1
period_s = 0.3
ramp_s = 0.14285714285714285
material_phase = [0.125, -0.1]
wave_axis = "z"
wave_periods_per_body = 0.5
wave_over_gaps = true
[collisions]
exclusion_depth = "off"
[integration]
time_step_fraction = 0.09
damping = "velocity"
number = "float32"
single_precision_rest_lengths = true
bond_damping = "semi-implicit"
[limits]
speed_fraction = 0.3
strain = 2
)";

Physics parse_earlier(const std::string& text) {
  Physics physics;
  io::read_described(io::parse_toml(text, "archive"), physics, io::StudyReader::EarlierNames::read);
  return physics;
}

TEST(PhysicsFile, ReadsWhatEarlierVersionsWrote) {
  Physics expected = unlike_the_defaults();
  expected.beam_moments = BeamMoments::published;  // there were no others
  EXPECT_EQ(parse_earlier(earlier_text), expected);
  EXPECT_EQ(unlike_the_defaults().actuation.period_s(), 0.3) << "the drive is the same to the last bit";
}

TEST(PhysicsFile, ReadsACalibratedBodyThatAnEarlierVersionWrote) {
  std::string parameters = surrogate_text(tests::surrogate_example());
  for (const auto& [now, before] : {std::pair{"\n[", "\n[surrogate.parameters."}, {"density_kg_per_m3", "density_kg_m3"}}) {
    for (std::size_t at = parameters.find(now); at != std::string::npos; at = parameters.find(now, at + 20))
      parameters.replace(at, std::string_view(now).size(), before);
  }
  const std::string text =
      "[materials.material_1]\nstatic_friction = 0.25\nkinetic_friction = 0.5\n[materials.material_2]\nstatic_friction = 1\n"
      "kinetic_friction = 0.5\n[damping]\ncollision = 0.8\nglobal = 0.01\n[environment]\ngravity_m_s2 = 9.81\nfloor = true\n"
      "[actuation]\nmode = \"in_phase\"\nperiod_s = 0.25\nramp_s = 0.5\n[surrogate]\npressure_Pa = [-1000, 1500]\n"
      "chambers = \"per-phase\"\noutside_range = \"warn\"\n[surrogate.parameters." +
      parameters.substr(1);
  EXPECT_EQ(parse_earlier(text), calibrated());
}

TEST(PhysicsFile, TextTellsTheSmallestDifferenceApart) {
  Physics other;
  other.damping_ratios.global = std::nextafter(other.damping_ratios.global, 1.0);
  EXPECT_NE(physics_text(other), physics_text(Physics{}));
}

TEST(PhysicsFile, AMaterialOfItsOwnOverridesTheCommonOne) {
  const Physics physics =
      parse("[materials]\nyoungs_modulus_Pa = 2e4\ndensity_kg_per_m3 = 20\n[materials.material_2]\nyoungs_modulus_Pa = 5e4\n");
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
                    BadPhysics{"[materials.material_2]\ndensity_kg_per_m3 = -3",
                               ": materials.material_2.density_kg_per_m3 = -3: must be > 0"},
                    BadPhysics{"[ground]\nkinetic_friction = \"high\"", ": ground.kinetic_friction = \"high\": "},
                    BadPhysics{"[materials]\nyoung = 4", ": materials.young: unknown key"},
                    BadPhysics{"[damping]\nbond = -0.5", ": damping.bond = -0.5: must be >= 0"},
                    BadPhysics{"[loads]\ngravity_m_per_s2 = -9.75", ": loads.gravity_m_per_s2 = -9.75: must be >= 0"},
                    BadPhysics{"[ground]\npresent = 1", ": ground.present = 1: must be true or false"},
                    BadPhysics{"[drive]\namplitude = 1.0", ": drive.amplitude = 1"},
                    BadPhysics{"[drive]\nfrequency_Hz = 0", ": drive.frequency_Hz = 0: must be > 0"},
                    BadPhysics{"[drive]\nmode = \"waves\"", ": drive.mode = \"waves\": "},
                    BadPhysics{"[drive]\nwave_axis = \"w\"", ": drive.wave_axis = \"w\": "},
                    BadPhysics{"[drive]\nmaterial_phase = [0.5]", "must be two numbers, not 1"},
                    BadPhysics{"[collisions]\nexclusion_depth = 0", ": collisions.exclusion_depth = 0: must be >= 1"},
                    BadPhysics{"[collisions]\nexclusion_depth = 1.5", ": collisions.exclusion_depth = 1.5: "},
                    BadPhysics{"[collisions]\nexclusion_depth = \"none\"", ": collisions.exclusion_depth = \"none\": "},
                    BadPhysics{"[integration]\ntime_step_fraction = nan", ": integration.time_step_fraction = nan: "},
                    BadPhysics{"[integration]\nnumber = \"float16\"", ": integration.number = \"float16\": "},
                    BadPhysics{"[integration]\nnumber = \"float32\"",
                               ": integration.number = \"float32\": float32 does not work with damping from increments"},
                    BadPhysics{"[drive]\nramp_s = -1", ": drive.ramp_s = -1: must be >= 0"},
                    BadPhysics{"[materials]\nlateral_coupling = 1", ": materials.lateral_coupling = 1: must be in [0, 1)"},
                    BadPhysics{"[limits]\nstrain = 0", ": limits.strain = 0: must be > 0"},
                    BadPhysics{"[actuation]\nmode = \"none\"", "is called drive now"},
                    BadPhysics{"[drive]\nperiod_s = 0.5",
                               ": drive.period_s = 0.5: is called drive.frequency_Hz now, the reciprocal of this number"},
                    BadPhysics{"[environment]\nfloor = true", ": environment.floor = true: is called ground.present now"},
                    BadPhysics{"[materials]\nstatic_friction = 1", ": materials.static_friction = 1: is called ground.static"},
                    BadPhysics{"[drive]\npressure_Pa = [0, 1]", ": drive.pressure_Pa"},
                    BadPhysics{"[surrogate]\nchambers = \"single\"",
                               "surrogate.parameters or values is missing: give the name of a file"},
                    BadPhysics{"[surrogate.parameters.mass]\ndensity_kg_m3 = 1", "is called surrogate.values now"},
                    BadPhysics{"limits = 3", ": limits = 3: must be a table"}));

}  // namespace
}  // namespace menger::voxel
