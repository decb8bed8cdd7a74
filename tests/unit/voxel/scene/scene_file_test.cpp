#include "voxel/scene/scene_file.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/study/study_reader.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/design/design_file.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/described_study.h"
#include "tests/support/test_folder.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;

constexpr const char* bar = "[design]\ncell_edge_m = 0.02\ncells = [3, 1, 1]\ndigits = \"121\"\n";

/// A folder for the scene of one test.
class SceneFile : public testing::Test {
 protected:
  [[nodiscard]] Scene read(const std::string& text) const {
    io::write_whole(folder_ / "scene.toml", text);
    return read_scene(folder_ / "scene.toml").scene;
  }

  /// The message with which a scene is refused.
  [[nodiscard]] std::string refusal(const std::string& text, std::optional<int> level = {}) const {
    io::write_whole(folder_ / "scene.toml", text);
    try {
      static_cast<void>(read_scene(folder_ / "scene.toml", level));
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "accepted: " + text;
  }

  /// @param fault what the message says beside the name of the file, such as `key = value: must be > 0`
  void expect_refused(const std::string& text, const std::string& fault) const {
    const std::string message = refusal(text);
    EXPECT_NE(message.find((folder_ / "scene.toml").string()), std::string::npos) << message;
    EXPECT_NE(message.find(fault), std::string::npos) << "no " << fault << " in: " << message;
  }

  const tests::TestFolder folder_;
};

TEST_F(SceneFile, OnlyTheDesignMustBeGiven) {
  const Scene scene = read(bar);
  EXPECT_EQ(scene.design.body, meshes::Polycube::from_digits(3, 1, 1, "121"));
  EXPECT_EQ(scene.design.cell_edge_m, 0.02);
  Scene expected;
  expected.design = scene.design;
  EXPECT_EQ(scene, expected);
}

TEST_F(SceneFile, ReadsADesignFileRelativeToTheScene) {
  fs::create_directories(folder_ / "designs");
  const meshes::Design design{.name = "sponge", .body = meshes::menger_sponge(), .cell_edge_m = 0.01};
  meshes::write_design(folder_ / "designs/sponge.toml", design);
  EXPECT_EQ(read("[design]\nfile = \"designs/sponge.toml\"").design, design);
}

TEST_F(SceneFile, TextReadsBackAsTheSameScene) {
  Scene scene = read(bar);
  scene.level = 2;
  scene.duration_s = 1.0 / 3.0;
  scene.record_interval_s = 0.1 / 3.0;
  scene.energy_ledger = true;
  scene.output = {.frames = false, .pictures = false, .records_per_frame = 7};
  scene.physics.actuation.mode = ActuationMode::wave;
  EXPECT_EQ(read(scene_text(scene)), scene);
}

TEST_F(SceneFile, TemplateIsReadToTheDefaultsAndToEachAlternative) {
  const std::set<std::string> refused{"design.file", "surrogate", "integration.number = \"float32\""};
  tests::expect_template_is_read<Scene>([this](const std::string& text) { return read(text); }, refused);
}

/// A scene of a body; only its other keys are drawn by chance.
struct SceneOfABar : Scene {
  SceneOfABar() { design = {.name = "bar", .body = meshes::bar(3)}; }
};
void describe(io::StudyVisitor& visitor, SceneOfABar& scene) { describe(visitor, static_cast<Scene&>(scene)); }

TEST_F(SceneFile, TextsOfAllScenesAreReadBack) {
  tests::expect_texts_are_read_back<SceneOfABar>([](const std::string& text) {
    SceneOfABar scene;
    io::read_described(io::parse_toml(text, "scene.toml"), scene);
    return scene;
  });
}

TEST_F(SceneFile, ALevelFromOutsideTakesThePlaceOfTheFiles) {
  io::write_whole(folder_ / "scene.toml", std::string(bar) + "level = 3\n");
  EXPECT_EQ(read_scene(folder_ / "scene.toml").scene.level, 3);
  EXPECT_EQ(read_scene(folder_ / "scene.toml", 1).scene.level, 1);
}

TEST_F(SceneFile, RefusesALevelOutOfRangeUnderTheNameItWasGivenBy) {
  const std::string one_cell = "[design]\ncell_edge_m = 0.01\ncells = [1, 1, 1]\ndigits = \"1\"\n";
  EXPECT_EQ(read(one_cell + "level = 20\n").level, 20);
  expect_refused(one_cell + "level = 0\n", ": design.level = 0: must be in [1, 20]");
  expect_refused(one_cell + "level = 21\n", ": design.level = 21: must be in [1, 20]");
  expect_refused(one_cell + "level = 2147483647\n", ": design.level = 2147483647: must be in [1, 20]");
  EXPECT_EQ(refusal(one_cell + "level = 2\n", 0), "--level 0: must be in [1, 20]");
  EXPECT_EQ(refusal(one_cell + "level = 2\n", 21), "--level 21: must be in [1, 20]");
}

TEST_F(SceneFile, ListsTheFilesThatWereRead) {
  io::write_whole(folder_ / "scene.toml", bar);
  EXPECT_EQ(read_scene(folder_ / "scene.toml").files, std::vector{folder_ / "scene.toml"});
  meshes::write_design(folder_ / "sponge.toml", {.name = "sponge", .body = meshes::menger_sponge(), .cell_edge_m = 0.01});
  io::write_whole(folder_ / "scene.toml", "[design]\nfile = \"sponge.toml\"\n");
  EXPECT_EQ(read_scene(folder_ / "scene.toml").files, (std::vector{folder_ / "scene.toml", folder_ / "sponge.toml"}));
}

TEST_F(SceneFile, AShortRunIsRecordedAtItsEnd) {
  EXPECT_EQ(read(std::string("time.duration_s = 0.001\n").append(bar)).record_interval_s, 0.001);
}

TEST_F(SceneFile, RefusesBadValuesNamingFileKeyAndValue) {
  const auto with = [](const std::string& line) { return line + "\n" + bar; };
  expect_refused(std::string(bar) + "level = 1.5", ": design.level = 1.5: ");
  expect_refused(with("time.duration_s = -2"), ": time.duration_s = -2: ");
  expect_refused(with("time.duration_s = \"long\""), ": time.duration_s = \"long\": ");
  expect_refused(with("time.record_interval_s = 3.0"), ": time.record_interval_s = 3");
  expect_refused(with("time.record_interval_s = 9.5367431640625e-07"),
                 ": time.record_interval_s = 9.5367431640625e-07: makes more than a million records");
  expect_refused(with("output.records_per_frame = 0"), ": output.records_per_frame = 0: ");
  expect_refused(with("durations = 2"), ": durations: unknown key");
  expect_refused(with("output.movie = true"), ": output.movie: unknown key");
  expect_refused(with("materials.youngs_modulus_Pa = -1"), ": materials.youngs_modulus_Pa = -1: ");
  expect_refused(with("energy_ledger = true\nintegration = {number = \"float32\", damping = \"velocity\"}"),
                 ": energy_ledger = true: needs number = \"float64\"");
}

TEST_F(SceneFile, RefusesMoreFrictionWhileSlidingThanAtRest) {
  const auto with = [](const std::string& lines) { return lines + "\n" + bar; };
  expect_refused(with("ground = {static_friction = 0.4, kinetic_friction = 0.6}"),
                 ": ground.static_friction = 0.4: is less than kinetic_friction = 0.6");
  expect_refused(with("ground.static_friction = 0.4"), ": ground.static_friction = 0.4: is less than kinetic_friction = 0.5");
  expect_refused(with("ground.kinetic_friction = 1.5"), ": ground.kinetic_friction = 1.5: is more than static_friction = 1");
  expect_refused(with("materials.material_2.kinetic_friction = 2.0"),
                 ": materials.material_2.kinetic_friction = 2.0: is more than static_friction = 1");
  EXPECT_EQ(read(with("ground = {static_friction = 0.4, kinetic_friction = 0.4}")).physics.materials[0].static_friction, 0.4);
}

TEST_F(SceneFile, RefusesValuesThatNoMachineNumberCanSimulate) {
  const auto with = [](const std::string& lines) { return lines + "\n" + bar; };
  expect_refused(with("materials.youngs_modulus_Pa = 1e200"), "youngs_modulus_Pa = 1e+200");
  expect_refused(with("integration.time_step_fraction = 1e-320"), "time_step_fraction = 1e-320");
  expect_refused(with("time.duration_s = 1e300\ntime.record_interval_s = 1e300"), "duration_s = 1e+300");
}

TEST_F(SceneFile, RefusesBadDesignsNamingFileKeyAndValue) {
  expect_refused("time.duration_s = 1", ": design.layers or digits or file is missing: give one of them");
  expect_refused("design = 5", ": design = 5: must be a table");
  expect_refused("design = \"bar.toml\"", ": design = \"bar.toml\": is called design.file now");
  expect_refused(std::string("level = 2\n").append(bar), ": level = 2: is called design.level now");
  const auto design = [](const std::string& lines) { return "[design]\ncell_edge_m = 0.01\n" + lines; };
  expect_refused(design("cells = [3, 1, 1]\ndigits = \"000\""), ": design.digits = \"000\": the body is empty");
  expect_refused(design("cells = [3, 1, 1]\ndigits = \"13\""), ": design.digits = \"13\": ");
  expect_refused(design("cells = [3, 1, 1]\ndigits = \"131\""), ": design.digits = \"131\": ");
  expect_refused(design("cells = [3, 1]\ndigits = \"111\""), "must be three integers, not 2");
  expect_refused(design("cells = [3, 1.5, 1]\ndigits = \"111\""), ": design.cells[2] = 1.5: ");
  expect_refused(design("cells = [1000000, 1, 1]\ndigits = \"1\""), ": design.cells[1] = 1000000: ");
  expect_refused("[design]\ncell_edge_m = -0.01\ncells = [1, 1, 1]\ndigits = \"1\"", ": design.cell_edge_m = -0.01: ");
}

TEST_F(SceneFile, NamesAMissingDesignFile) {
  try {
    static_cast<void>(read("design.file = \"nowhere.toml\""));
    ADD_FAILURE();
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find((folder_ / "nowhere.toml").string()), std::string::npos) << error.what();
  }
  EXPECT_THROW(static_cast<void>(read_scene(folder_ / "no_scene.toml")), io::InputError);
}

TEST_F(SceneFile, RefusesALevelThatDoesNotFitMemoryBeforeBuildingIt) {
  const std::string sponge = "[design]\ncell_edge_m = 0.01\ndigits = \"" + meshes::menger_sponge().digits() + "\"\n";
  // At level 20 neither the grid nor its size in bytes can be represented.
  expect_refused(sponge + "level = 20\n", ": design.level = 20: the simulation would need about ");
  EXPECT_NE(refusal(sponge + "level = 1\n", 20).find("scene.toml: --level 20: the simulation would need about "),
            std::string::npos)
      << refusal(sponge + "level = 1\n", 20);
  io::write_whole(folder_ / "scene.toml", std::string(bar) + "level = 2\n");
  const std::size_t needed = estimated_memory_bytes(meshes::Polycube::from_digits(3, 1, 1, "121"), 2, 1);
  EXPECT_NO_THROW(static_cast<void>(read_scene(folder_ / "scene.toml", {}, needed)));
  EXPECT_THROW(static_cast<void>(read_scene(folder_ / "scene.toml", {}, needed - 1)), io::InputError);
}

TEST(Scene, MemoryEstimateGrowsWithTheFractalAndSaturates) {
  const meshes::Polycube sponge = meshes::menger_sponge();
  const std::size_t level_2 = estimated_memory_bytes(sponge, 2, 1);
  const std::size_t level_3 = estimated_memory_bytes(sponge, 3, 1);
  EXPECT_GT(level_3, 19 * level_2);
  EXPECT_LT(level_3, 28 * level_2);
  EXPECT_EQ(estimated_memory_bytes(sponge, 1000, 1), std::numeric_limits<std::size_t>::max());
}

TEST(Scene, BodyLengthIsTheLongestSideOfTheAggregate) {
  const meshes::Design sponge{.name = "", .body = meshes::menger_sponge(), .cell_edge_m = 0.01};
  EXPECT_DOUBLE_EQ(meshes::body_length_m(sponge, 3), 0.27);
  const meshes::Design bar_of_five{.name = "", .body = meshes::Polycube::from_digits(1, 5, 1, "11111"), .cell_edge_m = 0.01};
  EXPECT_DOUBLE_EQ(meshes::body_length_m(bar_of_five, 1), 0.05);
}

}  // namespace
}  // namespace menger::voxel
