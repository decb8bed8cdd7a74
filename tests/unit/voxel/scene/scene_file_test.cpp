#include "voxel/scene/scene_file.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "meshes/design/reference_shapes.h"
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
  EXPECT_EQ(read("design = \"designs/sponge.toml\"").design, design);
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

TEST_F(SceneFile, ALevelFromOutsideTakesThePlaceOfTheFiles) {
  io::write_whole(folder_ / "scene.toml", std::string("level = 3\n").append(bar));
  EXPECT_EQ(read_scene(folder_ / "scene.toml").scene.level, 3);
  EXPECT_EQ(read_scene(folder_ / "scene.toml", 1).scene.level, 1);
}

TEST_F(SceneFile, RefusesALevelOutOfRangeUnderTheNameItWasGivenBy) {
  const std::string one_cell = "[design]\ncell_edge_m = 0.01\ncells = [1, 1, 1]\ndigits = \"1\"\n";
  EXPECT_EQ(read("level = 20\n" + one_cell).level, 20);
  expect_refused("level = 0\n" + one_cell, ": level = 0: must be in [1, 20]");
  expect_refused("level = 21\n" + one_cell, ": level = 21: must be in [1, 20]");
  expect_refused("level = 2147483647\n" + one_cell, ": level = 2147483647: must be in [1, 20]");
  EXPECT_EQ(refusal("level = 2\n" + one_cell, 0), "--level 0: must be in [1, 20]");
  EXPECT_EQ(refusal("level = 2\n" + one_cell, 21), "--level 21: must be in [1, 20]");
}

TEST_F(SceneFile, ListsTheFilesThatWereRead) {
  io::write_whole(folder_ / "scene.toml", bar);
  EXPECT_EQ(read_scene(folder_ / "scene.toml").files, std::vector{folder_ / "scene.toml"});
  meshes::write_design(folder_ / "sponge.toml", {.name = "sponge", .body = meshes::menger_sponge(), .cell_edge_m = 0.01});
  io::write_whole(folder_ / "scene.toml", "design = \"sponge.toml\"\n");
  EXPECT_EQ(read_scene(folder_ / "scene.toml").files, (std::vector{folder_ / "scene.toml", folder_ / "sponge.toml"}));
}

TEST_F(SceneFile, AShortRunIsRecordedAtItsEnd) {
  EXPECT_EQ(read(std::string("duration_s = 0.001\n").append(bar)).record_interval_s, 0.001);
}

TEST_F(SceneFile, RefusesBadValuesNamingFileKeyAndValue) {
  const auto with = [](const std::string& line) { return line + "\n" + bar; };
  expect_refused(with("level = 1.5"), ": level = 1.5: ");
  expect_refused(with("duration_s = -2"), ": duration_s = -2: ");
  expect_refused(with("duration_s = \"long\""), ": duration_s = \"long\": ");
  expect_refused(with("record_interval_s = 3.0"), ": record_interval_s = 3");
  expect_refused(with("record_interval_s = 9.5367431640625e-07"),
                 ": record_interval_s = 9.5367431640625e-07: makes more than a million records");
  expect_refused(with("output.records_per_frame = 0"), ": output.records_per_frame = 0: ");
  expect_refused(with("durations = 2"), ": durations: unknown key");
  expect_refused(with("output.movie = true"), ": output.movie: unknown key");
  expect_refused(with("materials.youngs_modulus_Pa = -1"), ": materials.youngs_modulus_Pa = -1: ");
  expect_refused(with("energy_ledger = true\nintegration = {number = \"float32\", damping = \"velocity\"}"),
                 ": energy_ledger = true: needs number = \"float64\"");
}

TEST_F(SceneFile, RefusesValuesThatNoMachineNumberCanSimulate) {
  const auto with = [](const std::string& lines) { return lines + "\n" + bar; };
  expect_refused(with("materials.youngs_modulus_Pa = 1e200"), "youngs_modulus_Pa = 1e+200");
  expect_refused(with("integration.time_step_fraction = 1e-320"), "time_step_fraction = 1e-320");
  expect_refused(with("duration_s = 1e300\nrecord_interval_s = 1e300"), "duration_s = 1e+300");
}

TEST_F(SceneFile, RefusesBadDesignsNamingFileKeyAndValue) {
  const std::string either = "must be the name of a design file or a table [design]";
  expect_refused("level = 1", ": design: " + either);
  expect_refused("design = 5", ": design = 5: " + either);
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
    static_cast<void>(read("design = \"nowhere.toml\""));
    ADD_FAILURE();
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find((folder_ / "nowhere.toml").string()), std::string::npos) << error.what();
  }
  EXPECT_THROW(static_cast<void>(read_scene(folder_ / "no_scene.toml")), io::InputError);
}

TEST_F(SceneFile, RefusesALevelThatDoesNotFitMemoryBeforeBuildingIt) {
  const std::string sponge = "[design]\ncell_edge_m = 0.01\ndigits = \"" + meshes::menger_sponge().digits() + "\"\n";
  // At level 20 neither the grid nor its size in bytes can be represented.
  expect_refused("level = 20\n" + sponge, ": level = 20: the simulation would need about ");
  EXPECT_NE(refusal("level = 1\n" + sponge, 20).find("scene.toml: --level 20: the simulation would need about "),
            std::string::npos)
      << refusal("level = 1\n" + sponge, 20);
  io::write_whole(folder_ / "scene.toml", std::string("level = 2\n").append(bar));
  const std::size_t needed = estimated_memory_bytes(meshes::Polycube::from_digits(3, 1, 1, "121"), 2);
  EXPECT_NO_THROW(static_cast<void>(read_scene(folder_ / "scene.toml", {}, needed)));
  EXPECT_THROW(static_cast<void>(read_scene(folder_ / "scene.toml", {}, needed - 1)), io::InputError);
}

TEST(Scene, MemoryEstimateGrowsWithTheFractalAndSaturates) {
  const meshes::Polycube sponge = meshes::menger_sponge();
  const std::size_t level_2 = estimated_memory_bytes(sponge, 2);
  const std::size_t level_3 = estimated_memory_bytes(sponge, 3);
  EXPECT_GT(level_3, 19 * level_2);
  EXPECT_LT(level_3, 28 * level_2);
  EXPECT_EQ(estimated_memory_bytes(sponge, 1000), std::numeric_limits<std::size_t>::max());
}

TEST(Scene, BodyLengthIsTheLongestSideOfTheAggregate) {
  const meshes::Design sponge{.name = "", .body = meshes::menger_sponge(), .cell_edge_m = 0.01};
  EXPECT_DOUBLE_EQ(body_length_m(sponge, 3), 0.27);
  const meshes::Design bar_of_five{.name = "", .body = meshes::Polycube::from_digits(1, 5, 1, "11111"), .cell_edge_m = 0.01};
  EXPECT_DOUBLE_EQ(body_length_m(bar_of_five, 1), 0.05);
}

}  // namespace
}  // namespace menger::voxel
