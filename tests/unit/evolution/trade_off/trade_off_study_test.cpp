#include "evolution/trade_off/trade_off_study.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "evolution/trade_off/trade_off_body.h"
#include "evolution/trade_off/trade_off_variant.h"
#include "evolution/trade_off/trade_off_voxels.h"
#include "io/process/program_job.h"
#include "io/study/installed_folders.h"
#include "io/study/study_reader.h"
#include "io/text/input_error.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "meshes/hexahedra/hollow_polycube.h"
#include "tests/support/described_study.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

/// A folder with a design and studies of it.
class TradeStudyTest : public testing::Test {
 protected:
  TradeStudyTest() { io::write_whole(folder_ / "design.toml", "name = \"cube\"\ncell_edge_m = 0.02\nlayers = [[\"1\"]]\n"); }

  [[nodiscard]] TradeStudy read(const std::string& text) const {
    io::write_whole(folder_ / "study.toml", text + "[design]\nfile = \"design.toml\"\n");
    return read_trade_study(folder_ / "study.toml");
  }

  /// Expects that reading is refused with a message that has all of these words.
  void expect_refused(const std::string& text, const std::vector<std::string>& words) const {
    try {
      (void)read(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const io::InputError& error) {
      for (const std::string& word : words) EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }

  const tests::TestFolder folder_;
};

TEST_F(TradeStudyTest, ADesignAloneRunsElementsAndAGait) {
  const TradeStudy study = read_trade_study(folder_ / "design.toml");
  EXPECT_EQ(study.design.name, "cube");
  EXPECT_TRUE(study.elements && study.gait);
  EXPECT_FALSE(study.settling || study.search);
  EXPECT_EQ(study.silicone, "dragon_skin_10");
  EXPECT_NEAR(study.shear_modulus_Pa, 4333850.0 / 50.0,
              1e-6);  // for this record `menger inflate` assumes a bulk modulus of 50 times this
}

TEST_F(TradeStudyTest, ReadsWhatIsAskedFor) {
  const TradeStudy study = read(
      "pressure_Pa = -500\nobservables = [\"extent_x\"]\ntarget_relative_errors = [0.1, 0.5]\n"
      "[finite_elements]\ndegrees = [2]\nbulk_ratios = [10, 1000]\n");
  EXPECT_EQ(study.pressure_Pa, -500.0);
  EXPECT_EQ(study.observables, std::vector{TradeObservable::extent_x});
  EXPECT_EQ(study.targets, (std::vector<double>{0.5, 0.1}));
  EXPECT_EQ(study.elements->degrees, std::vector{2});
  EXPECT_EQ(study.elements->bulk_ratios, (std::vector<double>{10, 1000}));
  EXPECT_FALSE(study.gait);
}

TEST_F(TradeStudyTest, ADesignMayBeDrawnInTheStudy) {
  io::write_whole(folder_ / "study.toml",
                  "[gait]\n[design]\nlayers = [[\"12\"]]\ncell_edge_m = 0.02\nwall_thickness_m = 0.003\nlevel = 2\n");
  const TradeStudy study = read_trade_study(folder_ / "study.toml");
  EXPECT_EQ(study.design.body.digits(), "12");
  EXPECT_EQ(study.design.cell_edge_m, 0.02);
  EXPECT_EQ(study.wall_thickness_m, 0.003);
  EXPECT_EQ(study.level, 2);
  EXPECT_EQ(read("[gait]\n").inputs.count((folder_ / "design.toml").string()), 1U);
}

TradeStudy described(const std::string& text) {
  TradeStudy study;
  io::read_described(io::parse_toml(text, "study.toml"), study);
  return study;
}

TEST_F(TradeStudyTest, ItsTemplateAndItsTextsAreReadBack) {
  tests::expect_template_is_read<TradeStudy>(described, {"design.file"});
  tests::expect_texts_are_read_back<TradeStudy>(described, 1, {"exclusion_depths"});
}

TEST_F(TradeStudyTest, KeysOfEarlierVersionsAreToldTheirNewNames) {
  io::write_whole(folder_ / "study.toml", "design = \"design.toml\"\n[gait]\n");
  EXPECT_NE(tests::message_of([&] { (void)read_trade_study(folder_ / "study.toml"); }).find("is called design.file now"),
            std::string::npos);
  expect_refused("wall_thickness_m = 0.001\n[gait]\n", {"is called design.wall_thickness_m now"});
  expect_refused("level = 2\n[gait]\n", {"is called design.level now"});
  expect_refused("chambers = \"single\"\n[gait]\n", {"is called design.chambers now"});
}

TEST_F(TradeStudyTest, WrongInputIsNamed) {
  expect_refused("", {"nothing to run"});
  expect_refused("[gait]\nspeed = 3\n", {"gait.speed", "unknown"});
  expect_refused("[finite_elements]\ndegrees = [3]\n", {"degrees", "3", "[1, 2]"});
  expect_refused("[finite_elements]\ndegrees = []\n", {"degrees", "at least one"});
  expect_refused("[finite_elements]\ndegrees = [1, 1]\n", {"degrees", "twice"});
  expect_refused("[finite_elements]\nelements_through_wall = [1.5]\n", {"elements_through_wall", "integer"});
  expect_refused("[gait]\n[voxels]\nexclusion_depths = [\"0\"]\n", {"exclusion_depths", "off"});
  expect_refused("[gait]\n[voxels]\nnumbers = [\"float16\"]\n", {"numbers", "float32"});
  expect_refused("pressure_Pa = 0\n[gait]\n", {"pressure_Pa", "0"});
  expect_refused("observables = [\"foot\"]\n[gait]\n", {"observables", "foot"});
  expect_refused("silicone = \"butter\"\n[gait]\n", {"silicone", "butter"});
  expect_refused("[settling]\nparameters = [\"p.toml\"]\n", {"finite_elements"});
  expect_refused("[search]\nstudy = \"s.toml\"\nseeds = [1, 2]\n", {"seeds", "three"});
  expect_refused("[search]\nstudy = \"missing.toml\"\n", {"missing.toml"});
  io::write_whole(folder_ / "evolve.toml", "preset = \"paper\"\n[budget]\nelement_steps = 1e6\n");
  expect_refused("[search]\nstudy = \"evolve.toml\"\n", {"evolve.toml: budget", "search.voxel_steps", "study.toml"});
  EXPECT_THROW((void)read_trade_study(folder_ / "missing.toml"), io::InputError);
}

TEST_F(TradeStudyTest, UnknownsOfAHollowCubeAreThoseOfTheGrid) {
  // 20 mm with walls of 2 mm: 11^3 nodes without 7^3 inside the chamber, or with middles 21^3 without 15^3; three unknowns each
  const TradeStudy study = read("[finite_elements]\n");
  EXPECT_EQ(count_elements(study, {}).unknowns, 3U * (11 * 11 * 11 - 7 * 7 * 7));
  EXPECT_EQ(count_elements(study, {.degree = 2}).unknowns, 3U * (21 * 21 * 21 - 15 * 15 * 15));
  EXPECT_EQ(count_elements(study, {}).elements, 10U * 10 * 10 - 8 * 8 * 8);
  // two layers of walls and two elements between them
  EXPECT_EQ(count_elements(study, {.thin_walls = fem::Fidelity::draft}).unknowns, 3U * (5 * 5 * 5 - 1));
}

TEST_F(TradeStudyTest, AVariantChangesItsKeysAndNoOthers) {
  io::write_whole(
      folder_ / "scene.toml",
      "[design]\nfile = \"d.toml\"\nlevel = 2\n[surrogate]\nparameters = \"p.toml\"\n[integration]\ndamping = \"increments\"\n"
      "[materials]\nyoungs_modulus_Pa = 12345.678901234567\n");
  TomlVariant variant(folder_ / "scene.toml");
  set_integration(variant, {"float32", "velocity", 0.45, "off", {}});
  variant.set({"design", "level"}, 1);
  const io::TomlTable read = io::parse_toml(variant.text(), "variant.toml");
  EXPECT_EQ(read.table("design").text("file"), (folder_ / "d.toml").string());
  EXPECT_EQ(read.table("surrogate").text("parameters"), (folder_ / "p.toml").string());
  EXPECT_EQ(read.table("design").integer("level"), 1);
  EXPECT_EQ(read.table("integration").text("number"), "float32");
  EXPECT_EQ(read.table("integration").text("damping"), "velocity");
  EXPECT_EQ(read.table("integration").number("time_step_fraction"), 0.45);
  EXPECT_EQ(read.table("collisions").text("exclusion_depth"), "off");
  EXPECT_EQ(read.table("materials").number("youngs_modulus_Pa"), 12345.678901234567);
  set_integration(variant, {"float64", "velocity", 0.45, "5", {}});
  EXPECT_EQ(io::parse_toml(variant.text(), "variant.toml").table("collisions").integer("exclusion_depth"), 5);
}

TEST_F(TradeStudyTest, ParametersThatASceneNamesAreInputs) {
  io::write_whole(folder_ / "scene.toml", "[surrogate]\nparameters = \"p.toml\"\n");
  io::write_whole(folder_ / "p.toml", "first");
  const TradeStudy before = read("[gait]\nscene = \"scene.toml\"\n");
  ASSERT_TRUE(before.inputs.contains((folder_ / "p.toml").string()));
  io::write_whole(folder_ / "p.toml", "second");
  const TradeStudy after = read("[gait]\nscene = \"scene.toml\"\n");
  EXPECT_NE(after.inputs.at((folder_ / "p.toml").string()), before.inputs.at((folder_ / "p.toml").string()));
  fs::remove(folder_ / "p.toml");
  EXPECT_THROW((void)read("[gait]\nscene = \"scene.toml\"\n"), io::InputError);
}

TEST_F(TradeStudyTest, ParametersOfAVariantArePartOfTheJob) {
  io::write_whole(folder_ / "scene.toml", "[surrogate]\nparameters = \"p.toml\"\n");
  const auto hash = [&](const std::string& content) {
    io::write_whole(folder_ / "p.toml", content);
    io::ProgramJob job;
    job.program = folder_ / "scene.toml";  // any file
    add_input(job, "scene.toml", TomlVariant(folder_ / "scene.toml"));
    EXPECT_EQ(job.inputs.at("parameters.toml"), content);
    EXPECT_EQ(io::parse_toml(job.inputs.at("scene.toml"), "scene.toml").table("surrogate").text("parameters"), "parameters.toml");
    return io::job_hash(job);
  };
  const std::string first = hash("first");
  EXPECT_NE(hash("second"), first);
  EXPECT_EQ(hash("first"), first);
}

TEST_F(TradeStudyTest, AVariantMayNameWhatComesWithMenger) {
  io::write_whole(folder_ / "scene.toml",
                  "[surrogate]\nparameters = \"dragon_skin_10_1cm\"\n[material]\nsilicone = \"dragon_skin_10\"\n");
  const fs::path parameters = io::data_folder(io::parameter_data) / "dragon_skin_10_1cm.toml";
  const fs::path silicone = io::data_folder(io::silicone_data) / "dragon_skin_10.toml";
  EXPECT_EQ(TomlVariant(folder_ / "scene.toml").files(),
            (std::map<std::string, fs::path>{{"parameters.toml", parameters}, {"silicone.toml", silicone}}));
  io::ProgramJob job;
  add_input(job, "scene.toml", TomlVariant(folder_ / "scene.toml"));
  EXPECT_EQ(job.inputs.at("parameters.toml"), io::read_whole(parameters));
  EXPECT_EQ(job.inputs.at("silicone.toml"), io::read_whole(silicone));
  EXPECT_EQ(io::parse_toml(job.inputs.at("scene.toml"), "scene.toml").table("material").text("silicone"), "silicone.toml");
  const TradeStudy study = read("[gait]\nscene = \"scene.toml\"\n");
  EXPECT_TRUE(study.inputs.contains(parameters.string()));
  io::write_whole(folder_ / "scene.toml", "[surrogate]\nparameters = \"dragon_skin\"\n");
  EXPECT_THROW(TomlVariant{folder_ / "scene.toml"}, io::InputError);
}

TEST_F(TradeStudyTest, AVariantFindsASiliconeBesideItsFile) {
  io::write_whole(folder_ / "scene.toml", "[material]\nsilicone = \"mine.toml\"\n");
  io::write_whole(folder_ / "mine.toml", "of the user");
  EXPECT_EQ(TomlVariant(folder_ / "scene.toml").files().at("silicone.toml"), folder_ / "mine.toml");
}

TEST_F(TradeStudyTest, AVariantOfWhatIsNoTomlIsRefused) {
  io::write_whole(folder_ / "scene.toml", "design = \n");
  EXPECT_THROW(TomlVariant{folder_ / "scene.toml"}, io::InputError);
  io::write_whole(folder_ / "scene.toml", "integration = 3\n");
  TomlVariant variant(folder_ / "scene.toml");
  EXPECT_THROW(variant.set({"integration", "number"}, "float64"), io::InputError);
}

}  // namespace
}  // namespace menger::evolution
