// Scenes that use calibrated parameters: read, refused, run.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "io/text/input_error.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "tests/support/surrogate_example.h"
#include "tests/support/test_folder.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/scene/physics_file.h"
#include "voxel/scene/scene_file.h"
#include "voxel/simulate/simulation_run.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;

const std::string bar = "[design]\ncell_edge_m = 0.01\ncells = [3, 1, 1]\ndigits = \"121\"\n";
const std::string use = "[surrogate]\nparameters = \"soft.toml\"\n";
const std::string in_phase = "[drive]\nmode = \"in_phase\"\npressure_Pa = [-500, 1500]\n";

class CalibratedScene : public testing::Test {
 protected:
  CalibratedScene() { write(tests::surrogate_example()); }

  void write(const SurrogateParameters& parameters) const { io::write_whole(folder_ / "soft.toml", surrogate_text(parameters)); }
  [[nodiscard]] LoadedScene load(const std::string& text) const {
    io::write_whole(folder_ / "scene.toml", text);
    return read_scene(folder_ / "scene.toml");
  }
  void expect_refused(const std::string& text, const std::string& fault) const {
    std::string message = "accepted";
    try {
      static_cast<void>(load(text));
    } catch (const io::InputError& error) {
      message = error.what();
    }
    EXPECT_NE(message.find(fault), std::string::npos) << "no " << fault << " in: " << message;
    EXPECT_NE(message.find("scene.toml"), std::string::npos) << message;
  }

  const tests::TestFolder folder_;
};

TEST_F(CalibratedScene, TakesItsParametersFromTheirFile) {
  const LoadedScene loaded = load(bar + "level = 2\n" + use + in_phase + "[ground]\nkinetic_friction = 0.3\n");
  ASSERT_TRUE(loaded.scene.physics.surrogate);
  const CalibratedBody& body = *loaded.scene.physics.surrogate;
  EXPECT_EQ(body.parameters, tests::surrogate_example());
  EXPECT_EQ(body.pressure_Pa, (std::array{-500.0, 1500.0}));
  EXPECT_EQ(body.chambers, meshes::ChamberLayout::single);
  EXPECT_EQ(body.outside_range, OutsideRange::refuse);
  EXPECT_EQ(body.level, 2);
  EXPECT_EQ(loaded.scene.physics.materials[1].kinetic_friction, 0.3);
  EXPECT_EQ(loaded.files, (std::vector<fs::path>{folder_ / "scene.toml", folder_ / "soft.toml"}));
}

TEST_F(CalibratedScene, TextReadsBackAsTheSameScene) {
  Scene scene = load(bar + use + "chambers = \"per-phase\"\noutside_range = \"warn\"\n" +
                     "[drive]\nmode = \"hold\"\nramp_s = 0.3\npressure_Pa = [-500, 1500]\n")
                    .scene;
  EXPECT_EQ(scene.physics.surrogate->chambers, meshes::ChamberLayout::per_phase);
  EXPECT_EQ(scene.physics.actuation.ramp_s, 0.3);
  EXPECT_EQ(load(scene_text(scene)).scene, scene);
  SurrogateParameters other = tests::surrogate_example();
  other.bulge[3].slope_per_Pa *= 1.0 + 1e-15;
  Scene changed = scene;
  changed.physics.surrogate->parameters = other;
  EXPECT_NE(physics_text(changed.physics), physics_text(scene.physics));
}

TEST_F(CalibratedScene, PlainCouplingReadsBack) {
  const Scene scene = load(bar + "[materials]\nlateral_coupling = 0.4\ndensity_kg_per_m3 = 20\n").scene;
  EXPECT_EQ(scene.physics.lateral_coupling, 0.4);
  EXPECT_EQ(load(scene_text(scene)).scene, scene);
  expect_refused(bar + "[materials]\nlateral_coupling = 1\n", "materials.lateral_coupling = 1: must be in [0, 1)");
}

TEST_F(CalibratedScene, RefusesKeysThatItsParametersDecide) {
  const std::string scene = bar + use + in_phase;
  const std::string contradiction = "belongs to a body without [surrogate]; with [surrogate] its parameters give this value";
  expect_refused(scene + "[materials]\nyoungs_modulus_Pa = 1e4\n", "materials.youngs_modulus_Pa = 10000.0: " + contradiction);
  expect_refused(scene + "[materials.material_2]\ndensity_kg_per_m3 = 1000\n",
                 "materials.material_2.density_kg_per_m3 = 1000: " + contradiction);
  expect_refused(scene + "[materials]\nlateral_coupling = 0.2\n", contradiction);
  expect_refused(scene + "amplitude = 0.25\n", "drive.amplitude = 0.25: " + contradiction);
  expect_refused(scene + "[damping]\nbond = 0.25\n", "damping.bond = 0.25: " + contradiction);
  expect_refused(scene + "[integration]\nbond_damping = \"semi-implicit\"\n", contradiction);
  expect_refused(scene + "[ground]\nstop_rotation = true\n",
                 "belongs to a body without [surrogate]; with [surrogate] the body stands on the feet");
  expect_refused(bar + in_phase, "drive.pressure_Pa = [-500, 1500]: belongs to [surrogate]");
}

TEST_F(CalibratedScene, RefusesParametersOfAnotherBodyNamingBothNumbers) {
  expect_refused("[design]\ncell_edge_m = 0.02\ncells = [1, 1, 1]\ndigits = \"1\"\n" + use + in_phase,
                 "calibrated for cell_edge_m = 0.01, the design has cell_edge_m = 0.02");
  expect_refused(bar + use + "wall_thickness_m = 0.0015\n", "wall_thickness_m = 0.0015: the parameters are calibrated for 0.002");
  expect_refused(bar + use + "silicone = \"hard\"\n", "silicone = \"hard\": the parameters are calibrated for \"soft\"");
}

TEST_F(CalibratedScene, RefusesADesignInPiecesWhichNobodyCouldCast) {
  const std::string apart = "[design]\ncell_edge_m = 0.01\ncells = [3, 1, 1]\ndigits = \"101\"\n";
  expect_refused(apart + use + in_phase, "the body is in 2 pieces, which cannot be cast as one body");
  EXPECT_NO_THROW((void)load(apart));
}

TEST_F(CalibratedScene, OfLevelOneInPiecesIsRefusedWhoeverMadeIt) {
  Scene scene = load(bar + use + in_phase).scene;
  scene.design.body = meshes::Polycube::from_digits(3, 1, 1, "101");
  EXPECT_THROW((void)run_scene(scene, folder_ / "out"), io::InputError);
  EXPECT_FALSE(fs::exists(folder_ / "out" / "result.toml"));
}

TEST_F(CalibratedScene, OfLevelTwoInPiecesRunsWithANote) {
  // Modules that are apart in themselves, and modules that do not all touch.
  for (const auto& [digits, pieces] : {std::pair{"101000000", 4U}, std::pair{"110100000", 3U}}) {
    Scene scene = load("[design]\nlevel = 2\ncell_edge_m = 0.01\ncells = [3, 3, 1]\ndigits = \"" + std::string(digits) + "\"\n" +
                       use + "outside_range = \"warn\"\n" + in_phase)
                      .scene;
    scene.duration_s = scene.record_interval_s = 0.01;
    scene.output.pictures = false;
    const SceneResult result = run_scene(scene, folder_ / "out");
    EXPECT_EQ(result.status, io::RunStatus::completed) << result.reason;
    EXPECT_EQ(result.parts, pieces) << digits;
    ASSERT_FALSE(result.notes.empty());
    EXPECT_NE(result.notes.front().find("that no beam joins: they are separate bodies"), std::string::npos)
        << result.notes.front();
  }
}

TEST_F(CalibratedScene, NotesModulesThatDoNotTouch) {
  // The feet of a quadruped at level 2: each piece is a hollow body of its own.
  Scene scene = load("[design]\nlevel = 2\ncell_edge_m = 0.01\ncells = [3, 3, 3]\ndigits = \"101000101111111111000000000\"\n" +
                     use + "outside_range = \"warn\"\n" + in_phase)
                    .scene;
  scene.duration_s = scene.record_interval_s = 0.01;
  scene.output.pictures = false;
  const SceneResult result = run_scene(scene, folder_ / "out");
  EXPECT_EQ(result.status, io::RunStatus::completed) << result.reason;
  ASSERT_EQ(result.parts, 5U);
  EXPECT_NE(result.notes.front().find("separate bodies"), std::string::npos) << result.notes.front();
}

TEST_F(CalibratedScene, RampsItsPressureOverAPeriodUnlessItSaysOtherwise) {
  const auto ramp_s = [&](const std::string& keys) { return load(bar + use + in_phase + keys).scene.physics.actuation.ramp_s; };
  EXPECT_EQ(ramp_s("frequency_Hz = 4\n"), 0.25);
  EXPECT_EQ(ramp_s("ramp_s = 0.1\n"), 0.1);
  EXPECT_EQ(ramp_s("ramp_s = 0\n"), 0.0);
  EXPECT_EQ(load(bar + "[drive]\nmode = \"in_phase\"\n").scene.physics.actuation.ramp_s, 0.0)
      << "solid voxels start in mid-swing";
  const Scene step = load(bar + use + in_phase + "ramp_s = 0\n").scene;
  EXPECT_EQ(load(scene_text(step)).scene, step);
}

TEST_F(CalibratedScene, RefusesStiffnessBeyondAllScales) {
  for (const double modulus_Pa : {1e30, 1e200}) {
    SurrogateParameters parameters = tests::surrogate_example();
    parameters.torsion_Pa[5] = modulus_Pa;
    write(parameters);
    expect_refused(bar + use + in_phase,
                   modulus_Pa > 1e30 ? "torsion_Pa[6] = 1e+200: must be at most" : "torsion_Pa = 1e+30: duration_s");
  }
}

TEST_F(CalibratedScene, RefusesBadUseOfParameters) {
  const auto surrogate = [](const std::string& keys) { return bar + use + keys; };
  expect_refused(surrogate(""), "drive.pressure_Pa is missing");
  expect_refused(surrogate("[drive]\npressure_Pa = [1]\n"), "drive.pressure_Pa = [1]: must be two numbers, not 1");
  expect_refused(surrogate("[drive]\npressure_Pa = [2, 1]\n"), "must ascend");
  expect_refused(surrogate("range = 3\n" + in_phase), "surrogate.range: unknown key");
  expect_refused(surrogate("outside_range = \"ignore\"\n" + in_phase), "\"refuse\" | \"warn\"");
  expect_refused(surrogate("pressure_Pa = [0, 1]\n"), "surrogate.pressure_Pa = [0, 1]: is called drive.pressure_Pa now");
  expect_refused(bar + "[surrogate]\n" + in_phase, "surrogate.parameters or values is missing");
}

TEST_F(CalibratedScene, RefusesWhatLeavesTheRangeOfValidityUnlessToldToWarn) {
  const std::string strong = "mode = \"in_phase\"\npressure_Pa = [0, 2500]\n";
  expect_refused(bar + use + "[drive]\n" + strong,
                 "pressure_Pa = 2500 is outside the range of the fit for such a body, -2000 to 2000 Pa");
  Scene scene = load(bar + use + "outside_range = \"warn\"\n[drive]\n" + strong).scene;
  scene.duration_s = 0.01;
  scene.record_interval_s = 0.01;
  scene.output.pictures = false;
  const SceneResult result = run_scene(scene, folder_ / "out");
  EXPECT_EQ(result.status, io::RunStatus::completed) << result.reason;
  ASSERT_FALSE(result.outside_validity.empty());
  EXPECT_NE(result.outside_validity.front().find("pressure_Pa = 2500"), std::string::npos);
  EXPECT_NE(io::read_whole(folder_ / "out" / "result.toml").find("pressure_Pa = 2500"), std::string::npos);
}

TEST_F(CalibratedScene, TellsTheRangeOfPressuresInFewDigits) {
  SurrogateParameters parameters = tests::surrogate_example();
  parameters.validity.highest_pressure_Pa.fill(1277.441139158422);
  write(parameters);
  expect_refused(bar + use + "[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 2500]\n",
                 "-2000 to 1277 Pa; beyond, the fit does not know voxels with ");
}

TEST_F(CalibratedScene, StatesThatStrainsLeftTheRange) {
  SurrogateParameters parameters = tests::surrogate_example();
  // Less than the bar is strained by while it rubs on the ground.
  parameters.validity.smallest_strain = -1e-6;
  parameters.validity.largest_strain = 1e-6;
  write(parameters);
  Scene scene = load(bar + use + "outside_range = \"warn\"\n" + in_phase).scene;
  scene.duration_s = 0.1;
  scene.output.pictures = false;
  const SceneResult warned = run_scene(scene, folder_ / "warned");
  EXPECT_EQ(warned.status, io::RunStatus::completed);
  ASSERT_EQ(warned.outside_validity.size(), 1U);
  EXPECT_NE(warned.outside_validity[0].find("beams had strains from"), std::string::npos);
  scene.physics.surrogate->outside_range = OutsideRange::refuse;
  const SceneResult refused = run_scene(scene, folder_ / "refused");
  EXPECT_EQ(refused.status, io::RunStatus::diverged);
  EXPECT_NE(refused.reason.find("strain outside the range of validity"), std::string::npos) << refused.reason;
}

TEST_F(CalibratedScene, WithOneChamberAndTwoPhasesIsRefusedBeforeAnythingIsWritten) {
  const Scene scene = load(bar + use + "[drive]\npressure_Pa = [-500, 1500]\n").scene;  // antiphase by default
  try {
    static_cast<void>(run_scene(scene, folder_ / "out"));
    FAIL() << "accepted";
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a chamber has one pressure"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists(folder_ / "out" / "result.toml"));
}

}  // namespace
}  // namespace menger::voxel
